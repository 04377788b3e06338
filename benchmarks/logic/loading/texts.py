"""Texts: many facts, and many rules that hang on one another, from text to the first answer."""

import importlib.util
from collections.abc import Iterator
from dataclasses import dataclass
from functools import partial

from casper.kb.base import KnowledgeBase

from ..bounds import Bound, within
from ..figures import OURS, Amounts, Figure, Found, Sizes, attempt, repeated, timed
from ..peers import prolog
from ..peers.engines import NO_CLINGO

TITLE = "Loading texts"
TIMED = (
    "From text to the first answer, which needs the text's last clause (casper: `from_text` and `ask`; SWI-Prolog: "
    "`consult` of a file and one call; clingo: adding the text and grounding it). The chained rules are p1(X) :- "
    "p0(X), p2(X) :- p1(X) and so on, with one fact of p0."
)


@dataclass(frozen=True, slots=True)
class Text:
    """A text, a statement that follows from it, and within how many seconds it is promised to be answered."""

    text: str
    statement: str
    seconds: float


def texts(sizes: Sizes) -> dict[str, Text]:
    """Every text by its task."""
    rules, facts = sizes.chained, sizes.facts
    last = facts - 1
    plain = "".join(f"link(a{at}, b{at % 1000}).\n" for at in range(facts))
    mixed = "".join(f'seen("Place {at % 500}", {at}, {at % 97}.5).\n' for at in range(facts))
    chain = "p0(a).\n" + "".join(f"p{at + 1}(X) :- p{at}(X).\n" for at in range(rules))
    return {
        f"{rules:,} chained rules": Text(chain, f"p{rules}(a)", 1.0),
        f"{facts:,} facts": Text(plain, f"link(a{last}, b{last % 1000})", 1.5),
        f"{facts:,} facts with quoted names and floats": Text(
            mixed, f'seen("Place {last % 500}", {last}, {last % 97}.5)', 1.5
        ),
    }


def measure(sizes: Sizes) -> Found:
    """Every text by every engine that reads it."""
    for task, text in texts(sizes).items():
        seconds, found = repeated(partial(_ours, text), sizes)
        yield Figure(task, OURS, seconds, found)
        yield attempt(task, "swipl", partial(_prolog, text, sizes))
        yield attempt(task, "clingo", partial(_clingo, text))


def _ours(text: Text) -> bool:
    return KnowledgeBase.from_text(text.text).ask(text.statement)


def _prolog(text: Text, sizes: Sizes) -> tuple[float, bool] | str:
    return prolog.consulted(text.text, text.statement, sizes)


def _clingo(text: Text) -> tuple[float, bool] | str:
    if ".5)" in text.statement:
        return "it has no floats"
    if importlib.util.find_spec("clingo") is None:
        return NO_CLINGO
    from clingo import Control, parse_term

    control = Control(["-Wnone"])

    def read() -> None:
        control.add("base", [], text.text)
        control.ground([("base", [])])

    seconds, _ = timed(read)
    return seconds, control.symbolic_atoms[parse_term(text.statement)] is not None


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """Within so many seconds."""
    yield from (within(amounts, task, text.seconds, "s") for task, text in texts(sizes).items())
