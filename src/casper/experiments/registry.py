"""All experiments by name, and the sets of them that have a name of their own."""

from __future__ import annotations

from collections.abc import Sequence
from difflib import get_close_matches

from casper.experiments.experiment import Experiment
from casper.experiments.paper.focus import FOCUS_OF_LUNCH
from casper.experiments.paper.goals import GOALS
from casper.experiments.paper.movements import MOVEMENTS
from casper.experiments.paper.responses import RESPONSES
from casper.experiments.paper.results import RESULTS
from casper.experiments.paper.trees import PLANS, SCORE_EXAMPLE
from casper.experiments.paper.verification import VERIFICATION
from casper.experiments.studies.certainty import CERTAINTY
from casper.experiments.studies.many import MANY
from casper.experiments.studies.study import CROSSED, PARTNERS, STUDY
from casper.kb.errors import CasperError

KITCHEN = (SCORE_EXAMPLE, PLANS, GOALS, RESPONSES, MOVEMENTS, FOCUS_OF_LUNCH, RESULTS, VERIFICATION)
STUDIES = (MANY, PARTNERS, STUDY, CROSSED, CERTAINTY)
EXPERIMENTS = {experiment.name: experiment for experiment in (*KITCHEN, *STUDIES)}
SETS = {"kitchen": KITCHEN}
"""``kitchen`` is everything that the paper shows."""


def named(names: Sequence[str]) -> list[Experiment]:
    """The experiments of these names, each once; a set's name stands for all of it.

    Raises:
        CasperError: there is no such experiment; the sentence has the nearest names.
    """
    found: list[Experiment] = []
    for name in names:
        if name in SETS:
            found += SETS[name]
        elif name in EXPERIMENTS:
            found.append(EXPERIMENTS[name])
        else:
            close = get_close_matches(name, [*SETS, *EXPERIMENTS], n=3)
            hint = f"; did you mean {' or '.join(close)}?" if close else ""
            raise CasperError(f"there is no experiment {name!r}; there are {', '.join([*SETS, *EXPERIMENTS])}{hint}")
    return list({experiment.name: experiment for experiment in found}.values())
