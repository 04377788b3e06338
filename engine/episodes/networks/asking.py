"""What the knowledge base says to growing plans: conditions, and whether an agent may do an action.

Every answer is remembered by what was asked, bound as far as is known: for as long as the base stays as it is, and
where rules look at did/2 until something else has been observed.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import Any

from casper.engine.episodes.networks.items.numbering import numbered
from casper.engine.episodes.networks.items.terms import (
    Env,
    Slot,
    key_of,
    outward,
    resolved,
    slots_in,
    unified,
)
from casper.engine.episodes.networks.remembering import MOST_REMEMBERED, Asked, Failed, Remembering
from casper.engine.verification.history import Done, in_order
from casper.kb.reasons.why_not import Refusal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound

MOST_JOINED = 10_000  # conditions asked together, under whatever names
NOTHING: Env = {}


class Asking(Remembering):
    """Asks a knowledge base; without one every condition holds and everybody may do everything."""

    def __reduce__(self) -> tuple[Any, ...]:
        return Asking, (self.kb, self.past, self._before, self._gone)

    def forked(self) -> Asking:
        """One with the same past that goes its own way; what was asked of earlier moments is shared."""
        other = Asking(self.kb, self.past, self._before, self._gone)
        if not self.looks_back:
            other._known, other._verdicts = self._known, self._verdicts
            other.closing, other._groups, other._plain = self.closing, self._groups, self._plain
            other._joined, other._domains = self._joined, self._domains
        return other

    # --- conditions ------------------------------------------------------------------------------------------------

    def due(self, relation: Any, after: int = 0, moment: int = -1) -> Asked:
        """A condition that is due now, after the observation under way (1), or was at an earlier moment."""
        assert self._conditions is not None
        looks_back = self.looks_back and self._conditions.looks_back(Compound((relation[0], *relation[1:])))
        return ((self.now if moment < 0 else moment) + after if looks_back else 0, relation)

    def settled(
        self, waiting: Sequence[Asked], env: Env, doing: Compound | Done | None = None
    ) -> tuple[Env, tuple[Asked, ...]] | Failed:
        """The substitution after these conditions, and those that are still open; the reasons where one fails.

        ``doing`` is the observation under way, for conditions that are due after it.
        """
        if self.kb is None:
            return env, ()
        while waiting:
            still: list[Asked] = []
            known: list[Asked] = []  # the same, bound as far as is known
            before = env
            for moment, relation in waiting:
                bound = resolved(relation, env)
                is_open = self._plain.get((moment, bound))
                if is_open is not None:
                    if is_open:
                        still.append((moment, relation))
                        known.append((moment, bound))
                    continue
                closed = numbered(bound, {}, {})
                answer = self._answer(moment, closed, doing)
                if (answer is None or answer is closed) and moment <= self.now:
                    self._plain[moment, bound] = answer is None
                if answer is None:
                    still.append((moment, relation))
                    known.append((moment, bound))
                elif isinstance(answer, Refusal):
                    return Failed(answer.reasons)
                elif answer is not closed:
                    extended = unified(relation, answer, env)
                    if extended is None:
                        return Failed((f"{outward(closed)} does not hold",))
                    env = extended
            waiting = still
            if env is before and waiting:
                together = self._together(tuple(known))
                if isinstance(together, Failed):
                    return together
                if not together:
                    break
                env = {**env, **together}
        return env, tuple(dict.fromkeys(waiting))

    def needed(self, waiting: Sequence[Asked], env: Env, used: Collection[Slot]) -> tuple[Asked, ...] | Failed:
        """The open conditions that may still make a difference: not those that others satisfy, whatever becomes of
        ``used``.

        Conditions that share slots with one another and with nothing else are asked for together, once and for all.
        """
        if self.kb is None or not waiting:
            return tuple(waiting)
        groups: list[tuple[set[Slot], list[Asked]]] = []
        for moment, relation in waiting:
            relation = resolved(relation, env)
            slots, members = set(slots_in(relation)), [(moment, relation)]
            near = [group for group in groups if not slots.isdisjoint(group[0])]
            for group in near:
                groups.remove(group)
                slots |= group[0]
                members = [*group[1], *members]
            groups.append((slots, members))
        kept: list[Asked] = []
        for slots, members in groups:
            holds = None if not slots.isdisjoint(used) else self._hold(numbered(tuple(members), {}, {}))
            if holds is False:
                return Failed((f"nothing is {' and '.join(term_text(outward(r)) for _, r in members)} at once",))
            if holds is None:
                kept.extend(members)
        return tuple(kept)

    def _hold(self, group: tuple[Asked, ...]) -> bool | None:
        if group not in self._groups:
            assert self._conditions is not None
            moments = {moment for moment, _ in group}
            atoms = [outward(relation) for _, relation in group]
            moment = moments.pop()
            settled = not moments and self._is_known(moment)
            self._groups[group] = self._conditions.hold_together(atoms, self._history(moment)) if settled else None
        return self._groups[group]

    def _together(self, waiting: tuple[Asked, ...]) -> Env | Failed:
        """What open conditions, bound as far as is known, leave of each slot's values, where that is one.

        So ``{human(X)}`` and ``{vehicle(X)}`` exclude each other before anything is known of X.
        """
        key = key_of(waiting)
        known = self._joined.get(key)
        if known is None:
            if len(self._joined) > MOST_JOINED:
                self._joined.clear()
            known = self._joined[key] = self._left(waiting)
        return known

    def _left(self, waiting: Sequence[Asked]) -> Env | Failed:
        """By slot the one value that the conditions leave."""
        left: dict[Any, frozenset[Any]] = {}
        for moment, relation in waiting:
            for at, values in self._values(moment, relation).items():
                left[at] = left[at] & values if at in left else values
                if not left[at]:
                    both = numbered(tuple(dict.fromkeys([r for _, r in waiting if at in slots_in(r)])), {}, {})
                    return Failed((f"nothing is {' and '.join([term_text(outward(r)) for r in both])} at once",))
        return {at: next(iter(values)) for at, values in left.items() if len(values) == 1} or NOTHING

    def _values(self, moment: int, relation: Any) -> dict[Any, frozenset[Any]]:
        """By slot of an open condition the values it may have, where they are known."""
        assert self._conditions is not None
        known = self._domains.get((moment, relation))
        if known is None:
            names: Env = {}
            closed = numbered(relation, {}, names)
            if closed == relation:
                atom = outward(closed)
                found = self._conditions.values(atom, self._history(moment)) if self._is_known(moment) else {}
                ours = {outward(number): number for number in names}
                known = {ours[variable]: frozenset(map(_inner, values)) for variable, values in found.items()}
            else:
                general = self._values(moment, closed)
                known = {name: general[number] for name, number in names.items() if number in general}
            self._domains[moment, relation] = known
        return known

    def _answer(self, moment: int, relation: Any, doing: Compound | Done | None) -> Any:
        """The relation as it holds (the very object, where nothing is bound), a refusal, or None while it is open."""
        key = (moment, relation)
        if key in self._known:
            return self._known[key]
        if len(self._known) > MOST_REMEMBERED:
            self._known.clear()
        assert self._conditions is not None
        if 0 < moment < self._gone:
            return None
        history = self._history(moment)
        if doing is not None and moment > self.now:
            history = in_order([doing], history)
        atom = outward(relation)
        answer = self._conditions.answer(atom, history)
        if isinstance(answer, Compound):
            answer = relation if answer == atom else _inner(answer)
        if moment <= self.now:
            self._known[key] = answer
        return answer

    # --- actions ---------------------------------------------------------------------------------------------------

    def refusal(self, action: Any, agent: str | None) -> tuple[str, ...]:
        """Why the agent cannot have done the action; nothing where it can, or where nobody knows."""
        if self.kb is None or agent is None:
            return ()
        valid, reasons = self._judged(action, agent)
        return reasons if valid is False else ()

    def may(self, action: Any, agent: str) -> bool:
        """Whether it is known that the agent can do the action now."""
        return self.kb is not None and self._judged(action, agent)[0] is True

    def _judged(self, action: Any, agent: str) -> tuple[bool | None, tuple[str, ...]]:
        """What the knowledge base says of the action now (None: it is not known), and why not."""
        key = (self.now if self.looks_back else 0, agent, numbered(action, {}, {}))
        found = self._verdicts.get(key)
        if found is None:
            assert self.kb is not None
            if len(self._verdicts) > MOST_REMEMBERED:
                self._verdicts.clear()
            verdict = self.kb.verify(outward((action[0], agent, *key[2][1:])), self._history(self.now))
            found = self._verdicts[key] = verdict.valid, verdict.reasons
        return found


def _inner(term: Any) -> Any:
    return tuple([_inner(part) for part in term]) if isinstance(term, tuple) else term
