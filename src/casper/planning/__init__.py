"""Planners: Unified Planning's problems and plans in and out (docs/planning.md; needs ``casper-hri[planning]``).

In: the framework's problems and plans, PDDL and HDDL. Out: verdicts with reasons, domains, what is left of a plan.
Importing this registers the engine ``casper`` with the framework: ``PlanValidator(name="casper")``.
"""

from __future__ import annotations

from casper.kb.errors import CasperError

try:
    from unified_planning.environment import get_environment
except ImportError:
    raise CasperError("planning needs Unified Planning: pip install 'casper-hri[planning]'") from None

ENGINE = "casper"


def register() -> None:
    """Make ``PlanValidator(name="casper")`` work in the framework's global environment; done by importing this."""
    factory = get_environment().factory
    if ENGINE not in factory.engines:
        factory.add_engine(ENGINE, "casper.planning.engine", "CasperValidator")


register()
