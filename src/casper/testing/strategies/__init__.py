"""Strategies for hypothesis, bound to one's own domain: what they make is well typed by construction.

    from casper.testing.strategies import observations, statements
    @given(statements(kitchen))                        # any statement of the kitchen's actions
    @given(observations(kitchen, drop=0.3))            # what a partner may be seen to do, some steps unseen

Every one shrinks to something short: the first goal, no step dropped, the first values of a column.
"""

try:
    import hypothesis as hypothesis
except ImportError:
    from casper.kb.errors import CasperError

    raise CasperError("strategies need hypothesis: pip install 'casper-hri[testing]'") from None

from casper.testing.strategies.libraries import libraries as libraries
from casper.testing.strategies.libraries import plans as plans
from casper.testing.strategies.programs import programs as programs
from casper.testing.strategies.pursuits import Interleaving as Interleaving
from casper.testing.strategies.pursuits import Pursuit as Pursuit
from casper.testing.strategies.pursuits import interleavings as interleavings
from casper.testing.strategies.pursuits import observations as observations
from casper.testing.strategies.statements import facts as facts
from casper.testing.strategies.statements import statements as statements
from casper.testing.strategies.traces import world_traces as world_traces
