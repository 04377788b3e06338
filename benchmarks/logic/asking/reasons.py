"""Reasons: why, why_not and repair, in the kitchen and on the large base. No peer offers the three."""

import statistics
from collections.abc import Callable, Iterator
from itertools import islice
from random import Random
from typing import Any

from casper.kb.base import KnowledgeBase

from ..bounds import Bound, within
from ..deriving.ontology import as_facts, generated
from ..figures import OURS, Amounts, Figure, Sizes, now, per_call
from ..peers.engines import compiled, loaded
from .kitchen import kitchen

TITLE = "Reasons"
TIMED = (
    "One reason, warm. In the kitchen the median of repeated calls for one statement; on the ontology "
    "(axioms as facts) the median over different derived facts, or over facts that do not hold."
)
KITCHEN = {
    "kitchen: why, a provable statement": ("why", ("eat", "human", "biscuits", "plate")),
    "kitchen: why_not, a failed condition": ("why_not", ("eat", "tiago", "meal", "plate")),
    "kitchen: why_not, several failed conditions": ("why_not", ("wash", "plate", "meal", "hobs")),
    "kitchen: why_not, a broken constraint": ("why_not", ("pick_and_place", "human", "biscuits", "sink")),
    "kitchen: repair, a failed condition": ("repair", ("eat", "tiago", "meal", "plate")),
}
LARGE = "large base: {method}"


def measure(sizes: Sizes) -> Iterator[Figure]:
    """Both bases."""
    small = kitchen()
    for task, (method, statement) in KITCHEN.items():
        reason = getattr(small, method)
        seconds, found = per_call(reason, statement, sizes=sizes)
        yield Figure(task, OURS, seconds, bool(found))
    program = as_facts(generated(sizes.ontology))
    kb = loaded(program)
    compiled(kb, program)
    derived, missing = _statements(kb, set(program.facts["type"]), max(2, sizes.updates // 10))
    yield _over(kb.why, LARGE.format(method="why, a derived type"), derived)
    yield _over(kb.why_not, LARGE.format(method="why_not, a type that does not hold"), missing)
    yield _over(kb.repair, LARGE.format(method="repair, a type that does not hold"), missing[:3])


def _statements(kb: KnowledgeBase, given: set[Any], count: int) -> tuple[list[Any], list[Any]]:
    """Types that were derived, and types that do not hold."""
    random = Random(11)
    rows = sorted(kb.rows("type", 2))
    individuals, classes = sorted({x for x, _ in rows}), sorted({c for _, c in rows})
    derived = random.sample([("type", *row) for row in rows if row not in given], count)
    drawn = (("type", random.choice(individuals), random.choice(classes)) for _ in iter(int, 1))
    return derived, list(islice((statement for statement in drawn if not kb.ask(statement)), count))


def _over(reason: Callable[[Any], Any], task: str, statements: list[Any]) -> Figure:
    """The median over statements, the first of them asked once before."""
    reason(statements[0])
    times, found = [], 0
    for statement in statements:
        began = now()
        found += bool(reason(statement))
        times.append(now() - began)
    return Figure(task, OURS, statistics.median(times), found == len(statements))


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """What a refusal of the kitchen may cost."""
    yield from (within(amounts, task, 100, "µs") for task in KITCHEN if "why_not" in task)
