"""What asking remembers: what was done, and what the knowledge base answered, for as long as that stays true."""

from __future__ import annotations

from collections.abc import Hashable, Iterable
from typing import Any, NamedTuple, TypeAlias

from casper.engine.episodes.networks.items.terms import Env
from casper.engine.episodes.past import Past, with_statement
from casper.engine.verification.conditions import Conditions
from casper.engine.verification.history import Done, in_order
from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound

MOST_REMEMBERED = 100_000
MOST_MOMENTS = 200  # observations after each of which it is known what had happened
Asked: TypeAlias = "tuple[int, Any]"  # the moment when it was due (0: it makes no difference), and the relation


class Failed(NamedTuple):
    """That a condition does not hold, and why."""

    reasons: tuple[str, ...]


class Remembering:
    """A knowledge base, what was done so far, and what it answered.

    ``past`` are the last `MOST_MOMENTS` observations (None: not made out in full), ``before`` what was done before
    them, of which it is known that it was done, and when last (`engine.episodes.past`); ``gone`` is how many
    observations that was.
    """

    def __init__(
        self, kb: KnowledgeBase | None, past: Iterable[Done | None] = (), before: Past = (), gone: int = 0
    ) -> None:
        self.kb = kb
        self.past, self._before, self._gone = list(past), before, gone
        self._conditions = None if kb is None else Conditions(kb)
        self._changes = -1
        self._keep_up()

    def _keep_up(self) -> None:
        """Forget what an earlier state of the base said."""
        changes = 0 if self.kb is None else self.kb.changes
        if changes != self._changes:
            self._changes = changes
            self.looks_back = self.kb is not None and self.kb.depends_on_history
            self.asks_goals = self.kb is not None and self.kb.defines("goal", 1)
            self._known: dict[Asked, Any] = {}
            self.closing: dict[Hashable, bool] = {}  # of links (`corners`) and whole states: whether they can close
            self._plain: dict[Asked, bool] = {}  # by condition that binds nothing whether it is open; else it holds
            self._groups: dict[tuple[Asked, ...], bool | None] = {}
            self._joined: dict[Any, Env | Failed] = {}
            self._domains: dict[Asked, dict[Any, frozenset[Any]]] = {}
            self._verdicts: dict[tuple[int, str, Any], tuple[bool | None, tuple[str, ...]]] = {}

    @property
    def now(self) -> int:
        """How many observations there were that did/2 knows of."""
        return self._gone + len(self.past)

    @property
    def changes(self) -> int:
        """How often the base was changed: what was asked before may be otherwise."""
        self._keep_up()
        return self._changes

    def observed(self, statement: Compound | None, t: float | None) -> None:
        """Remember what was done, where anything looks back at it; None: it is not known what, or when."""
        self._keep_up()
        for known in (self.closing, self._groups, self._joined, self._domains, self._plain):
            if len(known) > MOST_REMEMBERED:
                known.clear()
        if self.looks_back:
            done = None if statement is None else statement if t is None else (statement, t)
            self.past.append(None if done is None else in_order([done], self._history(self.now))[-1])
            if len(self.past) > MOST_MOMENTS:  # what lies further back is known in general only
                self._gone += 1
                oldest = self.past.pop(0)
                self._before = self._before if oldest is None else with_statement(self._before, *oldest)

    def forget(self) -> None:
        """Take back what was done last."""
        if self.past:
            self.past.pop()
            self._joined, self._domains, self.closing, self._groups, self._plain = {}, {}, {}, {}, {}
            self._known = {key: answer for key, answer in self._known.items() if key[0] <= self.now}
            self._verdicts = {key: told for key, told in self._verdicts.items() if key[0] <= self.now}

    def _history(self, moment: int) -> Past:
        """What was done before the moment; at the first one, nothing."""
        lately = [done for done in self.past[: max(0, moment - self._gone)] if done is not None]
        return (*self._before, *lately) if moment else ()

    def _is_known(self, moment: int) -> bool:
        """Whether what had happened by a moment is known: it is not to come, nor too far back (0: nobody looks)."""
        return moment == 0 or self._gone <= moment <= self.now
