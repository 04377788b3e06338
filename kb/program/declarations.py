"""Directives that say something about predicates: ``dynamic``, ``stored``, ``table``, ``discontiguous``."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import NamedTuple

from casper.kb.errors import ProgramError
from casper.kb.terms.clauses import Directive, Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.kb.terms.values.ordering import standard_key


class Moded(NamedTuple):
    """One argument of a predicate that is kept least (``min``) or greatest (``max``) for each of the others."""

    at: int
    mode: str

    def is_better(self, new: Term, old: Term) -> bool:
        """Whether a value takes another one's place."""
        if not (isinstance(new, (int, float)) and isinstance(old, (int, float))):
            new, old = standard_key(new), standard_key(old)
        return bool(new < old if self.mode == "min" else new > old)


@dataclass(frozen=True)
class Declaration:
    """What a directive declares."""

    dynamic: tuple[Indicator, ...] = ()
    stored: tuple[Indicator, ...] = ()
    least: dict[Indicator, Moded] = field(default_factory=dict)


def declaration(directive: Directive) -> Declaration:
    """What a directive says; a list of predicates comes as one directive for each (`kb.text.directives`).

    Raises:
        ProgramError: a directive nobody knows.
    """
    term = directive.term
    sentence = f"the only directive is :- dynamic(name/arity), not {term_text(as_term(term))}"
    if term.arity == 1 and term.functor in ("dynamic", "discontiguous", "stored", "table"):
        named = _indicator(term[1])
        if named is not None:
            return Declaration((named,) * (term.functor == "dynamic"), (named,) * (term.functor == "stored"))
        least = _moded(term[1]) if term.functor == "table" else None
        if least is not None:
            return Declaration(least=least)
    if term.functor in ("table", "discontiguous", "stored"):
        sentence = f"{term.functor} needs name/arity" + (" or path(_, _, min)" if term.functor == "table" else "")
    raise ProgramError(sentence, directive.place)


def tabled(indicator: Indicator, moded: Moded) -> Directive:
    """The directive that declares a moded argument."""
    args = [moded.mode if at == moded.at else Variable(f"_#{at}") for at in range(indicator[1])]
    return Directive(Compound(("table", Compound((indicator[0], *args)))))


def _indicator(term: Term) -> Indicator | None:
    if isinstance(term, Compound) and term.indicator == ("/", 2):
        name, arity = term.args
        if isinstance(name, str) and isinstance(arity, int) and arity >= 0:
            return name, arity
    return None


def _moded(term: Term) -> dict[Indicator, Moded] | None:
    """The predicate of ``path(_, _, min)`` with its moded argument, if it has one; None where it is no such term."""
    if not isinstance(term, Compound) or not term.arity:
        return None
    modes = [Moded(at, str(arg)) for at, arg in enumerate(term.args) if arg in ("min", "max")]
    if len(modes) > 1 or not all(isinstance(arg, Variable) or arg in ("min", "max", "index") for arg in term.args):
        return None
    return {term.indicator: modes[0]} if modes else {}
