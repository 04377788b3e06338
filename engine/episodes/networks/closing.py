"""Whether what is open may still be done: by the heads of methods, and for tasks under way by a search upwards.

A task whose parameters fit no method, or one under way from which no way leads to all of it, is dropped with its state.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import Any, TypeAlias

from casper.engine.episodes.networks.asking import Asking
from casper.engine.episodes.networks.items.methods import Methods
from casper.engine.episodes.networks.items.numbering import numbered
from casper.engine.episodes.networks.items.terms import (
    CALL,
    LINK,
    PAR,
    SEQ,
    Env,
    Row,
    Slot,
    key_of,
    resolve,
    resolved,
    slots_in,
    unified,
)
from casper.engine.episodes.networks.remembering import Asked, Failed

MOST_TRIED = 100  # links looked at to see whether one can close
ABOVE = 1_000  # what is taken upwards has slots from here on, so that it fits whatever conditions a link comes with
Upwards: TypeAlias = "Callable[[Any, int], Iterator[tuple[Row, Env, tuple[Asked, ...]]]]"


class _Open:
    """Open conditions, bound as far as is known, with the slots that each says something of."""

    def __init__(self, due: tuple[Asked, ...], env: Env) -> None:
        self._due, self._env = due, env
        self._bound: list[tuple[Asked, tuple[Slot, ...]]] | None = None

    def about(self, link: Any) -> tuple[Asked, ...]:
        """Those that say something of the slots of a link that is bound, too."""
        if not self._due:
            return ()
        if self._bound is None:
            bound = [(moment, resolved(relation, self._env)) for moment, relation in self._due]
            self._bound = [(asked, slots_in(asked[1])) for asked in bound]
        own = set(slots_in(link))
        return tuple([asked for asked, slots in self._bound if not own.isdisjoint(slots)])


class Closing:
    """Whether open items may still be done.

    Args:
        methods: the grammar.
        asking: the knowledge base.
    """

    def __init__(self, methods: Methods, asking: Asking) -> None:
        self.methods, self.asking = methods, asking
        self._fitting: dict[Any, bool] = {}
        self._upwards: dict[Any, list[tuple[Row, Env, tuple[Asked, ...]]]] = {}

    def can_close(self, row: Row, env: Env, due: tuple[Asked, ...], upwards: Upwards) -> bool:
        """Whether every task that is open or under way may still be done, by what is known of its parameters.

        ``upwards``: what comes next where a task was done that another one began with, and the link on (`passing`).
        It is told each time, so that neither holds the other: what is let go of goes at once, and is no garbage.
        """
        return self._row(row, env, _Open(due, env), upwards)

    def _row(self, row: Row, env: Env, open_: _Open, upwards: Upwards) -> bool:
        for item in row:
            kind = item[0]
            if kind is LINK and not self._link(resolve(item, env), open_, upwards):
                return False
            if kind is CALL and not self._fits(resolve(item[1], env)):
                return False
            if (kind is PAR or kind is SEQ) and not self._row(item[1], env, open_, upwards):
                return False
        return True

    def _fits(self, term: Any) -> bool:
        """Whether a task can be done, by the heads of its methods."""
        known = self._fitting.get(term)
        if known is None:
            known = self._fitting[term] = self.methods.fits(numbered(term, {}, {}))
        return known

    def _link(self, link: Any, open_: _Open, upwards: Upwards) -> bool:
        """Whether there is a way upwards from what was done of a task to all of it, by their parameters and conditions.

        After `MOST_TRIED` steps it is taken for granted.
        """
        if self.asking.kb is None and len(link[1]) == 1:
            return True
        remembered, asked = self.asking.closing, (link, open_.about(link))
        key = key_of(asked)
        if key not in remembered:
            start = numbered(asked, {}, {})
            same = key_of(start)
            if same not in remembered:
                remembered[same] = self._search(start, upwards)
            remembered[key] = remembered[same]
        return remembered[key]

    def _search(self, start: Any, upwards: Upwards) -> bool:
        seen, waiting = {start}, [start]
        while waiting and len(seen) < MOST_TRIED:
            link, due = waiting.pop()
            closed = unified(link[1], link[2], {})
            if closed is not None and not isinstance(self.asking.settled(due, closed), Failed):
                return True
            if link not in self._upwards:
                self._upwards[link] = list(upwards(link, ABOVE))
            for row, env, asked in self._upwards[link]:
                settled = self.asking.settled((*due, *asked), env)
                if not isinstance(settled, Failed):
                    env, due_then = settled
                    onward = resolve(row[-1], env)
                    after = numbered((onward, _Open(due_then, env).about(onward)), {}, {})
                    if after not in seen:
                        seen.add(after)
                        waiting.append(after)
        return bool(waiting)
