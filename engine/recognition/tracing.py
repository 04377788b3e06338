"""The first of a chain's explanations that end in one leaf with so many marks, without listing any.

Explanations of equal weight come in the order of their marks, a needless observation (-1) before all leaves. R[t][i] is
how many of the observations from t on can be marked at most on the leaves from i on if the last mark is to be ``last``;
fewer can be marked, too. So the first explanation takes each observation for needless while R allows it, and otherwise
for the leftmost leaf that R allows.
"""

from __future__ import annotations

from collections.abc import Sequence

from casper.engine.recognition.states import NEEDLESS

IMPOSSIBLE = -1


def first_marks(leaves: Sequence[str], seen: Sequence[str], last: int, marked: int) -> tuple[int, ...]:
    """A leaf, or NEEDLESS, for every observation.

    Args:
        leaves: the names of the plan's leaves.
        seen: the names of the observations.
        last: the leaf of the last mark.
        marked: how many observations are marked; there must be such an explanation.
    """
    most = _most(leaves, seen, last)
    marks: list[int] = []
    begin, left = 0, marked
    for at, name in enumerate(seen):
        if left == 0 or most[at + 1][begin] >= left:
            marks.append(NEEDLESS)
            continue
        leaf = next(
            leaf for leaf in range(begin, last + 1)
            if leaves[leaf] == name and (left == 1 if leaf == last else most[at + 1][leaf + 1] >= left - 1)
        )  # fmt: skip
        marks.append(leaf)
        begin, left = leaf + 1, left - 1
    return tuple(marks)


def _most(leaves: Sequence[str], seen: Sequence[str], last: int) -> list[list[int]]:
    """R, for t up to the number of observations and i up to last + 1 (where nothing is left to mark)."""
    most = [[IMPOSSIBLE] * (last + 1) + [0]]
    for name in reversed(seen):
        after, row = most[-1], [IMPOSSIBLE] * (last + 1) + [0]
        for leaf in range(last, -1, -1):
            best = after[leaf]
            if leaf < last:
                best = max(best, row[leaf + 1])
            if leaves[leaf] == name and after[leaf + 1] != IMPOSSIBLE:
                best = max(best, 1 + after[leaf + 1])
            row[leaf] = best
        most.append(row)
    return most[::-1]
