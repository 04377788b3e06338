"""Charts: what a plan's shapes mean for its leaves, as bit masks (bit j = leaf j, in the order of ``plan.leaves``).

Observing a leaf *closes* it and every leaf that the plan puts before it; whatever the plan leaves open, in whatever
order, stays so. So a chart keeps what comes before every leaf, and the leaves of every optional part: they belong to
the plan once one of them was observed, and not before. Plans without shapes share one chart for each length: leaf j
comes after 0 … j-1, and all leaves belong.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

from casper.plans.plan import Action, Node, Plan, Shape, is_plain

Progress: TypeAlias = tuple[int, int, int, int]
"""Mask of the closed leaves, mask of the open optional parts that were entered, leaves of the plan, missed ones."""


@dataclass(frozen=True)
class Part:
    """An optional part: all its leaves, and those that belong to the plan once it is entered (not to a part in it)."""

    leaves: int
    own: int


@dataclass(frozen=True)
class Chart:
    """The order and the optional parts of a plan's leaves.

    ``before[j]`` are the leaves that come before leaf j, ``parts`` the optional parts, ``inside[j]`` (a mask over
    parts) those that leaf j stands in, ``mandatory`` the leaves that stand in none.
    """

    leaves: int
    before: tuple[int, ...]
    parts: tuple[Part, ...]
    inside: tuple[int, ...]
    mandatory: int
    _belongs: dict[int, int] = field(default_factory=dict, compare=False)

    @cached_property
    def is_chain(self) -> bool:
        """Whether each leaf simply comes after the one before, and none is optional."""
        return not self.parts and all(mask == (1 << j) - 1 for j, mask in enumerate(self.before))

    @property
    def start(self) -> Progress:
        """Nothing closed, nothing entered, only the mandatory leaves belong to the plan."""
        return (0, 0, self.mandatory.bit_count(), 0)

    def close(self, progress: Progress, leaf: int) -> Progress:
        """The progress after an open leaf was observed."""
        closed, entered, size, missed = progress
        newly = (self.before[leaf] | 1 << leaf) & ~closed
        closed |= newly
        if not self.parts:
            return (closed, 0, size, missed + newly.bit_count() - 1)
        joined = self.inside[leaf] & ~entered
        entered |= joined
        missed += (newly & self.belonging(entered)).bit_count() - 1
        size += sum(part.own.bit_count() for at, part in enumerate(self.parts) if joined >> at & 1)
        still_open = sum(1 << at for at, part in enumerate(self.parts) if entered >> at & 1 and part.leaves & ~closed)
        return (closed, still_open, size, missed)

    def directly_before(self, leaf: int) -> list[int]:
        """The leaves that must come before this one, but for those that must come before another of them."""
        earlier = self.before[leaf]
        if self.is_chain:
            return [leaf - 1] if leaf else []
        covered = _union(self.before[j] for j in range(self.leaves) if earlier >> j & 1)
        return [j for j in range(self.leaves) if (earlier & ~covered) >> j & 1]

    def entered(self, closed: int) -> int:
        """The optional parts that were entered and are still open: those that are closed in part."""
        return _union(1 << at for at, p in enumerate(self.parts) if p.leaves & closed and p.leaves & ~closed)

    def next_leaves(self, closed: int) -> list[int]:
        """The leaves that may be done next without missing any."""
        progress = (closed, self.entered(closed), 0, 0)
        return [j for j in range(self.leaves) if not closed >> j & 1 and not self.close(progress, j)[3]]

    def belonging(self, entered: int) -> int:
        """The leaves of the plan when these optional parts were entered."""
        mask = self._belongs.get(entered)
        if mask is None:
            mask = self.mandatory
            for at, part in enumerate(self.parts):
                if entered >> at & 1:
                    mask |= part.own
            self._belongs[entered] = mask
        return mask


_CHAINS: dict[int, Chart] = {}


def draw_chart(plan: Plan) -> Chart:
    """The chart of a plan (`Plan.chart` keeps it); plans without shapes share one for each length."""
    leaves = len(plan.leaves)
    if not is_plain(plan):
        return _drawn(plan, leaves)
    if leaves not in _CHAINS:
        everything = (1 << leaves) - 1
        before = tuple((1 << j) - 1 for j in range(leaves))
        _CHAINS[leaves] = Chart(leaves, before, (), (0,) * leaves, everything)
    return _CHAINS[leaves]


def _drawn(plan: Plan, leaves: int) -> Chart:
    before, inside = [0] * leaves, [0] * leaves
    spans: list[int] = []  # the leaves of every optional part
    count = 0

    def add(node: Node, earlier: int, within: int) -> int:
        """Number the node's leaves; the mask of them."""
        nonlocal count
        if isinstance(node, Action):
            before[count], inside[count] = earlier, within
            count += 1
            return 1 << count - 1
        number = -1
        if isinstance(node, Shape) and node.kind == "optional":
            number = len(spans)
            spans.append(0)
            within |= 1 << number
        masks: list[int] = []
        for child, needs in zip(node.children, children_before(node)):
            masks.append(add(child, earlier | _union(masks[i] for i in needs), within))
        mask = _union(masks)
        if number >= 0:
            spans[number] = mask
        return mask

    add(plan.root, 0, 0)
    innermost = [within.bit_length() - 1 for within in inside]  # parts are numbered from the outside in
    parts = tuple(
        Part(span, _union(1 << j for j in range(leaves) if innermost[j] == number))
        for number, span in enumerate(spans)
    )
    mandatory = _union(1 << j for j in range(leaves) if inside[j] == 0)
    return Chart(leaves, tuple(before), parts, tuple(inside), mandatory)


def children_before(node: Node) -> list[set[int]]:
    """Per child the numbers of the children that come before it (an action has none)."""
    children = () if isinstance(node, Action) else node.children
    if not isinstance(node, Shape) or node.kind in ("sequence", "optional"):
        return [set(range(at)) for at in range(len(children))]
    needs: list[set[int]] = [set() for _ in children]
    for first, then in sorted(node.order, key=lambda pair: pair[1]):  # children stand in an order that fits
        needs[then] |= {first} | needs[first]
    return needs


def _union(masks: Iterable[int]) -> int:
    total = 0
    for mask in masks:
        total |= mask
    return total
