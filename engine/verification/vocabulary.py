"""The actions that plans have, and what comes nearest to one that none of them has."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from difflib import get_close_matches
from typing import Any

from casper.engine.verification.observation import Observation, Observed, Seen, Uncertain, options_of, seen_of
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.terms.unification import renamed, unify
from casper.kb.text.reader import read_statement


@dataclass(frozen=True, slots=True)
class Foreign:
    """Why no plan has an action, and the nearest action of the plans (None: none comes close)."""

    reasons: tuple[str, ...]
    nearest: str | None

    def __str__(self) -> str:
        hint = (f"did you mean {self.nearest}?",) if self.nearest is not None else ()
        return "; ".join((*self.reasons, *hint))


class Vocabulary:
    """The actions of the plans, and whether and how an observed one is among them; by name: whatever its arguments."""

    def __init__(self, leaves: Iterable[Compound], by_name: bool = False) -> None:
        self._by_name_only = by_name
        self._by_name: dict[str, list[Compound]] = {}
        for leaf in leaves:
            self._by_name.setdefault(leaf.functor, []).append(leaf)
        self._indicators = list(dict.fromkeys(leaf.indicator for found in self._by_name.values() for leaf in found))

    def read(self, observed: Observed) -> Seen:
        """What was observed, where no plan need have it; of an uncertain action the options that plans have.

        Raises:
            ReadError: the text is no action. CasperError: likelihoods that are none.
        """
        if isinstance(observed, Uncertain):
            observed = dict(observed.options)
        if not isinstance(observed, Mapping):
            seen = _observation(observed)
            return seen if self._refusal(seen) or self._by_name_only else seen_of(seen, self._indicators)
        options = [(_observation(option), likelihood) for option, likelihood in observed.items()]
        everything = {*self._indicators, *((o.action, len(o.args or ())) for o, _ in options)}
        checked = seen_of(observed, everything)  # the likelihoods are some
        known = {option: likelihood for option, likelihood in options_of(checked) if not self._refusal(option)}
        return seen_of(known, everything) if known else checked

    def foreign(self, seen: Seen) -> Foreign | None:
        """Why no plan has it, as far as names and arguments tell; None where one may."""
        refusals = [self._refusal(option) for option, _ in options_of(seen)]
        reasons = tuple(dict.fromkeys(refusal for refusal in refusals if refusal is not None))
        if len(reasons) == 0 or None in refusals:
            return None
        likeliest = max(options_of(seen), key=lambda option: option[1])[0]
        return Foreign(reasons, self.nearest(likeliest))

    def _refusal(self, seen: Observation) -> str | None:
        leaves = self._by_name.get(seen.action)
        if leaves is None:
            return f"no plan has the action {seen.action}"
        if seen.args is None or self._by_name_only:
            return None
        takes = sorted({leaf.arity for leaf in leaves})
        if len(seen.args) not in takes:
            arities = " or ".join(map(str, takes))
            return f"{seen.action} takes {arities} arguments here (the agent is left out), not {len(seen.args)}"
        action = Compound((seen.action, *renamed(seen.args, -1)))
        if any(unify(leaf, action, {}) is not None for leaf in leaves):
            return None
        return f"no plan has {seen}"

    def nearest(self, seen: Observation) -> str | None:
        """The action of the closest name with most arguments in common; None where no name comes close."""
        close = [seen.action] if seen.action in self._by_name else get_close_matches(seen.action, self._by_name, n=1)
        if not close:
            return None
        given = seen.args or ()
        leaf = max(self._by_name[close[0]], key=lambda leaf: _alike(leaf.args, given))
        if len(leaf.args) == len(given):  # a parameter can be what was seen
            pairs = zip(leaf.args, given)
            leaf = Compound((leaf.functor, *(known if isinstance(arg, Variable) else arg for arg, known in pairs)))
        return term_text(as_term(leaf))


def names_only(leaves: Iterable[Compound]) -> Iterator[Compound]:
    """The leaves for those who look at names alone: whatever the arguments."""
    for leaf in leaves:
        yield Compound((leaf.functor, *(Variable("Argument", at) for at in range(len(leaf.args)))))


def _observation(observed: Any) -> Observation:
    if isinstance(observed, Observation):
        return observed
    term = read_statement(observed) if isinstance(observed, str) else predication(observed)
    return Observation(term.functor, term.args if len(term) > 1 else None)


def _alike(args: Sequence[Term], given: Sequence[Term]) -> tuple[bool, int, int]:
    pairs = list(zip(args, given))
    agree = sum(one == other for one, other in pairs)
    return len(args) == len(given), agree + sum(isinstance(one, Variable) for one, _ in pairs), agree
