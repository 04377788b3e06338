"""The first of a chain's explanations that are equally good, without listing any.

Explanations of equal weight come in the order of their marks, a needless observation (-1) before all leaves.
"""

from __future__ import annotations

from collections.abc import Sequence

from casper.engine.recognition.kernels.kernel import NEEDLESS, Marks
from casper.engine.verification.observation import Seen
from casper.plans.trees.plan import Plan

IMPOSSIBLE = -1


def leftmost(plan: Plan, seen: Sequence[Seen]) -> Marks:
    """The first and best one that takes nothing for needless; there must be one."""
    leaves, at, marks = plan.leaves, 0, []
    for one in seen:
        action = one.action
        while leaves[at][0] != action:
            at += 1
        marks.append(at)
        at += 1
    return tuple(marks)


def first_marks(leaves: Sequence[str], seen: Sequence[str], last: int, marked: int) -> Marks:
    """The first one that marks so many observations, and ``last`` at last; there must be one.

    R[t][i] is how many of the observations from t on can be marked at most on the leaves from i on if the last mark is
    to be ``last``; fewer can be marked, too. So each observation is needless while R allows it, and otherwise the
    leftmost leaf that R allows.
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
