"""Conditions on what was seen that nothing seen can ever meet: a relation or a label that there is not."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from difflib import get_close_matches

from casper.engine.perception.perception import perception_settings
from casper.engine.perception.remembering.asked import ASKED, DURING
from casper.engine.perception.remembering.memory import ARITIES, WORDS
from casper.kb.base import KnowledgeBase
from casper.kb.checks.finding import Finding, error
from casper.kb.errors import CasperError
from casper.kb.program.control import plain_clauses
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term


def misread_memories(clauses: Iterable[Clause], kb: KnowledgeBase) -> Iterator[Finding]:
    """Each condition of a clause that asks for what is never seen, with its place.

    Relations that the clauses define themselves are their own.
    """
    found = list(clauses)
    own = {clause.head.indicator for clause in found}
    labels = _labels(kb)
    with suppress(CasperError):  # which is told elsewhere
        for clause in plain_clauses(found):
            for literal in clause.body:
                for name, args in () if literal.atom.indicator in own else _asked(literal):
                    sentence = _mistake(name, args, labels)
                    if sentence:
                        place = literal.place if literal.place.line else clause.place
                        yield error(place, f"{term_text(as_term(literal.atom))} is never so: {sentence}")


def _labels(kb: KnowledgeBase) -> dict[str, tuple[str, ...]]:
    try:
        bands = tuple(label for label, _ in perception_settings(kb.rows).bands)
    except CasperError:  # which is told of the settings
        bands = ()
    return {"qdc": bands, "qtc": tuple(WORDS.values()), "mos": ("moving", "stationary")}


def _asked(literal: Literal) -> Iterator[tuple[str, tuple[object, ...]]]:
    """The relation a condition asks for, and its arguments behind the time."""
    atom = literal.atom
    if atom.indicator in ASKED and atom.indicator != DURING:
        yield atom.functor, atom.args[1:]
    elif atom.indicator == DURING and isinstance(atom[1], Compound):
        yield atom[1].functor, atom[1].args


def _mistake(name: str, args: tuple[object, ...], labels: dict[str, tuple[str, ...]]) -> str:
    if len(args) + 1 != ARITIES.get(name):
        known = ", ".join(f"{each}/{arity - 1}" for each, arity in ARITIES.items())
        return f"what lasts is one of {known}, not {name}/{len(args)}"
    label, wanted = args[-1], labels.get(name)
    if not wanted or not isinstance(label, str) or label in wanted:
        return ""
    close = get_close_matches(label, wanted, n=1)
    return f"{name} has {', '.join(wanted)}" + (f"; did you mean {close[0]}?" if close else "")
