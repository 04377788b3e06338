"""The nearest action of the plans to one that none of them has."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from difflib import get_close_matches

from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term
from casper.kb.terms.unification import renamed, unify


class Vocabulary:
    """The actions of the plans, and whether and how an observed one is among them."""

    def __init__(self, leaves: Iterable[Compound]) -> None:
        self._by_name: dict[str, list[Compound]] = {}
        for leaf in leaves:
            self._by_name.setdefault(leaf.functor, []).append(leaf)

    @property
    def indicators(self) -> list[tuple[str, int]]:
        """Name and arity of every action, each once."""
        return list(dict.fromkeys(leaf.indicator for leaves in self._by_name.values() for leaf in leaves))

    def refusal(self, action: str, args: Sequence[Term] | None) -> str | None:
        """Why no plan has the action with these arguments (None: they were not seen); None where some plan has."""
        leaves = self._by_name.get(action)
        if leaves is None:
            return f"no plan has the action {action}"
        if args is None or any(unify(leaf, Compound((action, *renamed(args, -1))), {}) is not None for leaf in leaves):
            return None
        takes = sorted({leaf.arity for leaf in leaves})
        if len(args) not in takes:
            return f"{action} takes {' or '.join(map(str, takes))} arguments here, not {len(args)}"
        return f"no plan has {term_text(as_term(Compound((action, *args))))}"

    def nearest(self, action: str, args: Sequence[Term] | None) -> str | None:
        """The action of the closest name with most arguments in common; None where no name comes close."""
        close = [action] if action in self._by_name else get_close_matches(action, list(self._by_name), n=1)
        if not close:
            return None
        given = tuple(args or ())
        leaf = max(self._by_name[close[0]], key=lambda leaf: _alike(leaf.args, given))
        if len(leaf.args) == len(given):  # a parameter can be what was seen
            pairs = zip(leaf.args, given)
            leaf = Compound((leaf.functor, *(seen if isinstance(arg, Variable) else arg for arg, seen in pairs)))
        return term_text(as_term(leaf))


def _alike(args: Sequence[Term], given: Sequence[Term]) -> tuple[bool, int, int]:
    pairs = list(zip(args, given))
    agree = sum(one == other for one, other in pairs)
    return len(args) == len(given), agree + sum(isinstance(one, Variable) for one, _ in pairs), agree
