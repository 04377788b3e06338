"""Names in a question that nothing here has: behind a bare "no" there is most often a slip of the pen.

>>> [str(found) for found in strangers(KnowledgeBase.from_text("cup(mug). wash(X) :- cup(X)."), "wash(mugg)")]
['nothing here is called mugg; did you mean mug?']
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from difflib import get_close_matches

from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError
from casper.kb.store.queries import conditions_of
from casper.kb.terms.atoms import NIL
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.control import CONTROL
from casper.kb.terms.syntax import COMPARISONS, term_text
from casper.kb.terms.terms import Compound, Term

_OURS = BUILTINS | CONTROL
MOST_COMPARED = 20_000  # names among which a near one is looked for


@dataclass(frozen=True, slots=True)
class Stranger:
    """A name that stands nowhere in a base, and the one that may be meant (empty: none is near)."""

    name: str
    near: str = ""

    def __str__(self) -> str:
        hint = f"; did you mean {term_text(self.near)}?" if self.near else ""
        return f"nothing here is called {term_text(self.name)}{hint}"


def strangers(kb: KnowledgeBase, question: str) -> list[Stranger]:
    """The names among the arguments of a question (conditions, or one statement) that the base has nowhere.

    A question that cannot be read has none: that is another mistake, which whoever asks it is told.
    """
    try:
        conditions = [literal.atom for body in conditions_of(question) for literal in body]
    except CasperError:
        return []
    asked = [atom for atom in conditions if not (atom.indicator in _OURS or atom.functor in COMPARISONS)]
    names = dict.fromkeys(name for atom in asked for name in _names(atom) if name != NIL)
    unknown = kb.unmentioned(names) if names else set()
    if not unknown:
        return []
    known = sorted(kb.names(MOST_COMPARED))
    return [Stranger(name, next(iter(_near(name, known)), "")) for name in names if name in unknown]


def _near(name: str, known: list[str]) -> list[str]:
    """The name that is meant: the same in other letters, or one that differs little."""
    same = [other for other in known if other.lower() == name.lower()]
    return same or get_close_matches(name, known, n=1)


def _names(atom: Compound) -> Iterator[str]:
    """The constants among the arguments, inside terms and statements as well."""
    waiting: list[Term] = list(reversed(atom.args))
    while waiting:
        term = waiting.pop()
        if isinstance(term, str):
            yield term
        elif isinstance(term, Compound):
            waiting.extend(reversed(term.args))
