"""Asserting and retracting one fact on the large base, against deriving everything again."""

import statistics
from collections.abc import Callable, Iterator
from random import Random
from typing import Any

from casper.kb.base import KnowledgeBase

from ..bounds import Bound, within
from ..figures import OURS, Amounts, Figure, Row, Rows, Sizes, Skipped, now, timed
from ..peers.engines import Program, answers_of, compiled, has, loaded
from .ontology import Ontology, as_facts, generated

TITLE = "Updates of the large base"
TIMED = (
    "One fact at a time on the ontology (axioms as facts), warm, with an `ask` for that fact: the median "
    "over different facts. After each series the whole base is compared with one that was built anew. The "
    "recomputation is that base's derivation, without its loading."
)
ASSERT, RETRACT, GIVEN = (
    "assert a {name} fact",
    "retract a {name} fact, a new one",
    "retract a {name} fact, a given one",
)
AGAIN = "recomputation"


def measure(sizes: Sizes) -> Iterator[Figure | Skipped]:
    """New facts in and out again, and facts out that were there from the start."""
    ontology = generated(sizes.ontology)
    program = as_facts(ontology)
    kb = loaded(program)
    seconds, _ = timed(lambda: compiled(kb, program))
    if not (has(kb, "assert_") and has(kb, "retract")):
        yield Figure(ASSERT.format(name="type"), AGAIN, seconds)
        yield Skipped(TITLE, OURS, "the knowledge base has no assert_ and retract yet")
        return
    for name, new in new_facts(ontology, sizes.updates).items():
        given = Random(5).sample(program.facts[name], min(sizes.updates, len(program.facts[name]) // 2))
        kept = sorted(set(program.facts[name]) - set(given))
        series = (
            (ASSERT, kb.assert_, new, program.facts[name] + new),
            (RETRACT, kb.retract, new, program.facts[name]),
            (GIVEN, kb.retract, given, kept),
        )
        for task, change, rows, expected in series:
            label = task.format(name=name)
            yield Figure(label, OURS, _median(kb, change, name, rows), answers_of(kb, program))
            yield _anew(label, Program({**program.facts, name: expected}, program.rules, program.counted))
        for row in given:
            kb.assert_((name, *row))


def new_facts(ontology: Ontology, count: int) -> dict[str, Rows]:
    """Facts about individuals and classes of the ontology that it does not state."""
    random = Random(7)
    types, links = set(ontology.types), set(ontology.links)
    individuals, classes = sorted({x for x, _ in types}), sorted({c for _, c in types})
    properties = sorted({p for _, p, _ in links})
    drawn_types = ((random.choice(individuals), random.choice(classes)) for _ in range(9 * count))
    ends = (random.sample(individuals, 2) for _ in range(9 * count))
    drawn_links = ((one, random.choice(properties), other) for one, other in ends)
    return {"type": _first(drawn_types, types, count), "holds": _first(drawn_links, links, count)}


def _first(rows: Iterator[Row], taken: set[Row], count: int) -> Rows:
    return list(dict.fromkeys(row for row in rows if row not in taken))[:count]


def _median(kb: KnowledgeBase, change: Callable[[Any], Any], name: str, rows: Rows) -> float:
    """Median seconds of one change and one question, the first tenth of the changes aside (they warm up)."""
    statements = [(name, *row) for row in rows]
    times = [timed_change(kb, change, statement) for statement in statements]
    return statistics.median(times[len(times) // 10 :])


def timed_change(kb: KnowledgeBase, change: Callable[[Any], Any], statement: tuple[Any, ...]) -> float:
    """Seconds of a change and of asking for its fact, so that upkeep cannot be put off."""
    began = now()
    change(statement)
    kb.ask(statement)
    return now() - began


def _anew(label: str, program: Program) -> Figure:
    kb = loaded(program)
    seconds, _ = timed(lambda: compiled(kb, program))
    return Figure(label, AGAIN, seconds, answers_of(kb, program))


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """What one change and one question may cost."""
    for name in ("type", "holds"):
        yield within(amounts, ASSERT.format(name=name), 100, "µs")
        yield within(amounts, RETRACT.format(name=name), 1000, "µs")
        yield within(amounts, GIVEN.format(name=name), 1000, "µs")
