"""Which things are related: those that are named, or everything an observer is related to, or all."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from itertools import permutations

from casper.kb.errors import TraceError
from casper.qsr.calculi.calculus import Names

MOST = 20_000_000
"""Tuples that are made without being named; more are refused."""
_WORDS = {1: "things", 2: "pairs", 3: "triples"}


@dataclass(frozen=True)
class Related:
    """Who is related to whom, for calculi of one, two and three places.

    observer: the first of every tuple; None: anybody. things, pairs, triples: those and no others, in place of what an
    observer, or everybody, gives.
    """

    observer: str | None = None
    things: tuple[str, ...] | None = None
    pairs: tuple[Names, ...] | None = None
    triples: tuple[Names, ...] | None = None

    @staticmethod
    def of(
        observer: str | None = None,
        things: Iterable[str] | None = None,
        pairs: Iterable[Sequence[str]] | None = None,
        triples: Iterable[Sequence[str]] | None = None,
    ) -> Related:
        """As given, once each.

        Raises:
            TraceError: a pair or triple of the wrong length, or of one thing with itself.
        """
        return Related(
            observer,
            None if things is None else tuple(dict.fromkeys(things)),
            None if pairs is None else _tuples(pairs, 2),
            None if triples is None else _tuples(triples, 3),
        )

    def tuples(self, arity: int, names: Sequence[str]) -> tuple[Names, ...]:
        """The tuples of that many among these names, in the order of the names.

        Raises:
            TraceError: nothing is named, and there are too many.
        """
        named = {1: None if self.things is None else tuple((n,) for n in self.things), 2: self.pairs, 3: self.triples}
        chosen = named[arity]
        if chosen is not None:
            there = set(names)
            return tuple(row for row in chosen if there.issuperset(row))
        others = [name for name in names if name != self.observer]
        if self.observer is None:
            _bounded(len(names), arity, _WORDS[arity])
            return tuple(permutations(names, arity))
        if self.observer not in names:
            return ()
        _bounded(len(others), arity - 1, _WORDS[arity])
        return tuple((self.observer, *row) for row in permutations(others, arity - 1))

    def named(self) -> set[str]:
        """Every name that is given."""
        rows = (self.pairs or ()) + (self.triples or ()) + ((self.things,) if self.things is not None else ())
        return {name for row in rows for name in row} | ({self.observer} if self.observer is not None else set())


def _tuples(given: Iterable[Sequence[str]], arity: int) -> tuple[Names, ...]:
    rows = tuple(dict.fromkeys(tuple(row) for row in given))
    for row in rows:
        if len(row) != arity or len(set(row)) != arity:
            raise TraceError(f"{_WORDS[arity]} are {arity} different names, not {row!r:.60}")
    return rows


def _bounded(things: int, arity: int, word: str) -> None:
    number = 1
    for taken in range(arity):
        number *= max(things - taken, 0)
    if number > MOST:
        raise TraceError(f"{things:,} things have {number:,} {word}; name an observer, or the {word} that are wanted")
