"""The large base as its user meets it: how long and how much memory until the first answer, and until all is derived.

A base beyond some thousands of facts answers from its facts and lists what follows only when that is asked for, so the
time of building it is no longer the time of deriving, and its memory holds no derived facts. What is measured is
therefore the whole way from rows or text to an answer that needs a rule, and to every row of the derived relations.
"""

import gc
import importlib.util
from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

from casper.kb.base import KnowledgeBase

from ..bounds import Bound, ratio
from ..figures import OURS, Amounts, Figure, Found, Sizes, attempt, repeated, timed
from ..peers.engines import NO_CLINGO, Program, atoms_of, compiled, everything, grounded, loaded
from ..peers.fresh import fresh, resident
from .ontology import as_facts, generated

TITLE = "The large base, from rows or text to answers"
TIMED = (
    "The ontology, axioms as facts. Until the first answer: building the base and asking for one type that takes an "
    "axiom. Until all is derived: building it and listing every row. Beside it deriving alone, of a base that is "
    "built. Memory is how much a fresh process has grown once its own rows or text are gone. clingo grounds, which "
    "derives all. A large base answers from its facts and lists what follows when that is asked for: the two promises "
    "made before that was so (loading against deriving, bytes a derived fact) would now compare with nothing, so they "
    "are about these two ways."
)
FIRST, ALL = "from {source}, until the first answer that needs a rule", "from {source}, until all is derived"
ALONE = "deriving alone, of a base that is built"
MEMORY_FIRST, MEMORY_ALL = "memory at the first answer", "memory once all is derived"
SOURCES = ("rows", "text")


def measure(sizes: Sizes) -> Found:
    """Times, and memory."""
    program = as_facts(generated(sizes.ontology))
    text, asked = program.text(), needing_a_rule(program)
    ways: dict[str, Callable[[], KnowledgeBase]] = {
        "rows": partial(loaded, program),
        "text": partial(KnowledgeBase.from_text, text),
    }
    for source, build in ways.items():
        seconds, found = repeated(partial(_asked, build, asked), sizes)
        yield Figure(FIRST.format(source=source), OURS, seconds, found)
        seconds, count = repeated(partial(_derived, build, program), sizes)
        yield Figure(ALL.format(source=source), OURS, seconds, count)
    yield attempt(ALL.format(source="text"), "clingo", partial(_all_in_clingo, text, program))
    yield _alone(program, sizes)
    yield from _memory(sizes)


def _asked(build: Callable[[], KnowledgeBase], statement: tuple[Any, ...]) -> bool:
    return build().ask(statement)


def _derived(build: Callable[[], KnowledgeBase], program: Program) -> int:
    return compiled(build(), program)


def needing_a_rule(program: Program) -> tuple[Any, ...]:
    """A type that is not stated, but follows by one subclass axiom."""
    stated, above = set(program.facts["type"]), {row[0]: row[1] for row in program.facts["subclass"]}
    return next(("type", x, above[c]) for x, c in program.facts["type"] if c in above and (x, above[c]) not in stated)


def _alone(program: Program, sizes: Sizes) -> Figure:
    times = []
    for _ in range(sizes.repeats):
        kb = loaded(program)
        times.append(timed(partial(compiled, kb, program)))
    times.sort()
    seconds, count = times[len(times) // 2]
    return Figure(ALONE, OURS, seconds, count)


def _all_in_clingo(text: str, program: Program) -> tuple[float, int] | str:
    """Seconds of reading the text and grounding it, and the number of rows, counted afterwards."""
    if importlib.util.find_spec("clingo") is None:
        return NO_CLINGO
    seconds, (_, control) = timed(lambda: grounded(text, (), ""))
    return seconds, sum(1 for counted in program.counted for _ in atoms_of(control, *counted))


def _memory(sizes: Sizes) -> Found:
    first, everything, given, count = fresh(_held, sizes.ontology)
    yield Figure(MEMORY_FIRST, OURS, first, unit="bytes")
    yield Figure(f"{MEMORY_FIRST}, a given fact", OURS, first / given, unit="bytes")
    yield Figure(MEMORY_ALL, OURS, everything, count, unit="bytes")
    yield Figure(f"{MEMORY_ALL}, a fact", OURS, everything / count, count, unit="bytes")
    theirs = attempt(MEMORY_ALL, "clingo", partial(fresh, _held_by_clingo, sizes.ontology))
    yield Figure(*_as_bytes(theirs)) if isinstance(theirs, Figure) else theirs


def _as_bytes(figure: Figure) -> tuple[str, str, float, Any, str]:
    return figure.task, figure.engine, figure.amount, figure.answers, "bytes"


def _held(share: float) -> tuple[int, int, int, int]:
    """In a fresh process: bytes at the first answer and once all is derived, given facts, all facts."""
    warm = as_facts(generated(0.01))
    compiled(loaded(warm), warm)  # the imports and caches are not the base's
    gc.collect()
    before = resident()
    program = as_facts(generated(share))
    kb, asked = loaded(program), needing_a_rule(program)
    given = sum(map(len, program.facts.values()))
    smallest, counted = program.smallest, program.counted
    del program
    assert kb.ask(asked)
    gc.collect()
    first = resident() - before
    count = everything(kb, smallest, counted)
    gc.collect()
    return first, resident() - before, given, count


def _held_by_clingo(share: float) -> tuple[float, int]:
    warm = as_facts(generated(0.01))
    grounded(warm.text(), (), "")
    gc.collect()
    before = resident()
    program = as_facts(generated(share))
    _, control = grounded(program.text(), (), "")
    counted = program.counted
    del program
    gc.collect()
    held = resident() - before
    return held, sum(1 for indicator in counted for _ in atoms_of(control, *indicator))


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """Nobody waits for what they do not ask, text is read fast, and memory stays in proportion to facts."""
    alone = (ALONE, OURS)
    for source, first, last in (("rows", 1, 2), ("text", 3, 3)):
        for task, bound in ((FIRST, first), (ALL, last)):
            name = task.format(source=source)
            yield ratio(amounts, f"{name}, against deriving alone", (name, OURS), alone, bound)
    for task in (f"{MEMORY_FIRST}, a given fact", f"{MEMORY_ALL}, a fact"):
        yield Bound(task, amounts.get((task, OURS)), 1024, "bytes")
