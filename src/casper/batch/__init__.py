"""Many rows at once: explanations, verdicts and recordings, over processes or an existing Dask cluster (docs/batch.md).

In: a domain and rows, from Python or a table. Out: one row for each, in their order, the same on every backend; what
cannot be worked on is a row with its mistake.

    >>> from casper.batch import explain_many
    >>> explain_many("kitchen", [["eat"], ["sip", "wash"]], jobs=2)
"""

from casper.batch.many import explain_many as explain_many
from casper.batch.many import verify_many as verify_many
from casper.batch.many import watch_many as watch_many
from casper.batch.trials import run_trials as run_trials
