"""Runs of one relation with their times, and the states that lie between those that cannot follow each other."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass

import numpy as np

from casper.kb.errors import TraceError
from casper.qsr.arrays.scene import Array
from casper.qsr.plain.between import between
from casper.qsr.results.relations import Column


@dataclass(frozen=True, slots=True)
class Episode:
    """A relation that held without interruption.

    relation: in each of the calculi that were collapsed together. begins, ends: seconds of the first and the last step
    at which it held; first, last: the numbers of these steps. inserted: it was not seen, but lies between two that
    were; it begins and ends half-way between them, and ``first`` is the step after it, ``last`` that before.
    """

    of: tuple[str, ...]
    relation: tuple[str, ...]
    begins: float
    ends: float
    first: int
    last: int
    inserted: bool = False

    @property
    def steps(self) -> int:
        """At how many steps it was seen."""
        return self.last - self.first + 1


def runs(codes: Array) -> tuple[Array, Array, Array]:
    """Where equal codes run, as (tuple, first step, last step), in the order of tuples and steps.

    codes: (tuples, T), or (calculi, tuples, T) where a run ends when any of them changes. Undefined ones are left out,
    and end a run.
    """
    cube = codes if codes.ndim == 3 else codes[None]
    changes = np.ones(cube.shape[1:], dtype=bool)
    changes[:, 1:] = (cube[:, :, 1:] != cube[:, :, :-1]).any(axis=0)
    of, first = np.nonzero(changes)
    ends = np.ones_like(changes)
    ends[:, :-1] = changes[:, 1:]
    last = np.nonzero(ends)[1]
    defined = (cube[:, of, first] >= 0).all(axis=0)
    return of[defined], first[defined], last[defined]


def collapse(*columns: Column) -> list[Episode]:
    """The episodes of every tuple, by tuple and time; of several calculi, those in which none of them changes.

    Raises:
        TraceError: the columns relate different tuples.
    """
    if not columns:
        raise TraceError("there is nothing to collapse; give columns of relations")
    one = columns[0]
    if any(each.of != one.of or len(each.t) != len(one.t) for each in columns):
        raise TraceError("only columns of the same tuples and steps are collapsed together")
    codes = np.stack([each.codes.astype(np.int16) for each in columns])
    found = []
    for i, first, last in zip(*(part.tolist() for part in runs(codes))):
        relation = tuple(each.labels[code] for each, code in zip(columns, codes[:, i, first].tolist()))
        found.append(Episode(one.of[i], relation, float(one.t[first]), float(one.t[last]), first, last))
    return found


def validate(episodes: Sequence[Episode]) -> list[Episode]:
    """The episodes of QTC with at most one put in between where one cannot follow the other; every time is kept.

    Nothing is put between those of different tuples, between those with missing steps between them, or where QTC_BC
    goes over from QTC_B to QTC_C or back.
    """
    return list(_validated(episodes))


def _validated(episodes: Sequence[Episode]) -> Iterator[Episode]:
    before: Episode | None = None
    for episode in episodes:
        if before is not None and before.of == episode.of and before.last + 1 == episode.first:
            one, other = before.relation[0], episode.relation[0]
            middle = between(one, other) if len(one) == len(other) else None
            if middle is not None:
                t = (before.ends + episode.begins) / 2.0
                yield Episode(
                    episode.of, (middle, *episode.relation[1:]), t, t, episode.first, before.last, inserted=True
                )
        yield episode
        before = episode
