"""Charts: what a plan's shapes mean for its leaves, as bit masks (bit j = leaf j, in the order of ``plan.leaves``).

Observing a leaf *closes* it and every leaf that the plan puts before it; whatever the plan leaves open, in whatever
order, stays so. Parts of a plan may be done or not: an optional part belongs to the plan once one of its leaves was
observed, and not before; an alternative likewise, and then the leaves of its rivals are closed and belong no more. As
long as a choice is open its smallest alternative stands for it. A condition is asked when the first leaf that comes
after it is observed or passed over, or once all before it is over where nothing comes after; one that stands in a part
only if the part belongs by then: of a choice that was passed over unseen it is not known which way was taken. Plans
without shapes share one chart for each length: leaf j comes after 0 … j-1, and all leaves belong.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from typing import TypeAlias

from casper.plans.trees.nodes import Action, Condition, Node, Shape, Task, actions_below, is_plain

Progress: TypeAlias = tuple[int, int, int, int]
"""Mask of the closed leaves, mask of the open parts that were entered, leaves of the plan, missed ones."""


@dataclass(frozen=True)
class Part:
    """An optional part, or an alternative of a choice.

    ``leaves`` are all its leaves, ``own`` those that belong to the plan once it is entered (and nothing in it is),
    ``rivals`` the leaves of the other alternatives, ``instead`` those that stood for the choice until then. A part
    ``is_spare`` when it is an alternative that another one stands for.
    """

    leaves: int
    own: int
    rivals: int = 0
    instead: int = 0
    is_spare: bool = False

    @property
    def growth(self) -> int:
        """How many leaves the plan has more once the part is entered."""
        return self.own.bit_count() - self.instead.bit_count()


@dataclass(frozen=True)
class Guard:
    """When a condition is asked: masks of the leaves before it and after it, and of the parts it stands in."""

    before: int
    after: int
    inside: int


@dataclass(frozen=True)
class Chart:
    """The order and the parts of a plan's leaves.

    ``before[j]`` are the leaves that come before leaf j, ``parts`` the optional parts and alternatives, the outer ones
    first, ``inside[j]`` (a mask over parts) those that leaf j stands in, ``mandatory`` the leaves that stand in none,
    ``expected`` those that belong to the plan before anything is observed. ``guards`` say when conditions are asked, in
    the order of ``plan.conditions``.
    """

    leaves: int
    before: tuple[int, ...]
    parts: tuple[Part, ...]
    inside: tuple[int, ...]
    mandatory: int
    expected: int
    guards: tuple[Guard, ...] = ()
    _belongs: dict[int, int] = field(default_factory=dict, compare=False)

    @cached_property
    def is_chain(self) -> bool:
        """Whether each leaf simply comes after the one before, and all are done."""
        return not self.parts and all(mask == (1 << j) - 1 for j, mask in enumerate(self.before))

    @property
    def start(self) -> Progress:
        """Nothing closed, nothing entered, only what is expected belongs to the plan."""
        return (0, 0, self.expected.bit_count(), 0)

    def close(self, progress: Progress, leaf: int) -> Progress:
        """The progress after an open leaf was observed."""
        closed, entered, size, missed = progress
        newly = self.before[leaf] | 1 << leaf
        if not self.parts:
            newly &= ~closed
            return (closed | newly, 0, size, missed + newly.bit_count() - 1)
        joined = self.inside[leaf] & ~entered
        for at in bits(joined):
            newly |= self.parts[at].rivals
            size += self.parts[at].growth
        newly &= ~closed
        entered |= joined
        missed += (newly & self.belonging(entered)).bit_count() - 1
        closed |= newly
        for at in bits(entered):
            if not (self.parts[at].leaves & ~closed or self.is_asked_later(at, closed)):  # it is over
                entered ^= 1 << at
        return (closed, entered, size, missed)

    def is_asked_later(self, part: int, closed: int) -> bool:
        """Whether a condition of the part is yet to be asked, by what comes after the part."""
        return any(g.inside >> part & 1 and g.after and not g.after & closed for g in self.guards)

    def asked(self, before: Progress, leaf: int) -> list[tuple[int, bool]]:
        """The conditions that observing the open leaf asks: their numbers, and whether they look at what follows it."""
        closed, entered, _, _ = before
        after = closed | self.before[leaf] | 1 << leaf
        entered |= self.inside[leaf]
        for at in bits(self.inside[leaf]):
            after |= self.parts[at].rivals
        found = []
        for number, guard in enumerate(self.guards):
            if guard.inside & ~entered:
                continue
            if guard.after:
                if guard.after & after and not guard.after & closed:
                    found.append((number, False))
            elif not guard.before & ~after and (guard.before & ~closed or not closed):
                found.append((number, True))
        return found

    def directly_before(self, leaf: int) -> list[int]:
        """The leaves that must come before this one, but for those that must come before another of them."""
        earlier = self.before[leaf]
        if self.is_chain:
            return [leaf - 1] if leaf else []
        covered = union(self.before[j] for j in bits(earlier))
        return list(bits(earlier & ~covered))

    @cached_property
    def choices(self) -> dict[int, tuple[int, int]]:
        """By part that is an alternative: the number of its choice and its own among the rivals, both from 0."""
        numbers: dict[int, int] = {}  # of choices, by the leaves of all their alternatives
        counts: dict[int, int] = {}
        found: dict[int, tuple[int, int]] = {}
        for at, part in enumerate(self.parts):
            if part.rivals:
                choice = numbers.setdefault(part.leaves | part.rivals, len(numbers))
                found[at] = choice, counts.get(choice, 0)
                counts[choice] = counts.get(choice, 0) + 1
        return found

    def entered(self, closed: int) -> int:
        """The parts that were entered and are still open: those that are closed in part."""
        return union(1 << at for at, p in enumerate(self.parts) if p.leaves & closed and p.leaves & ~closed)

    def next_leaves(self, closed: int) -> list[int]:
        """The leaves that may be done next without missing any."""
        if self.is_chain:
            return [closed.bit_length()] if closed.bit_length() < self.leaves else []
        progress = (closed, self.entered(closed), 0, 0)
        return [j for j in range(self.leaves) if not closed >> j & 1 and not self.close(progress, j)[3]]

    def coming_leaves(self, closed: int) -> list[int]:
        """The leaves yet to be done, optional ones too; of a choice that is open those of its smallest alternative."""
        if not self.parts:
            return [j for j in range(self.leaves) if not closed >> j & 1]
        aside = self.spares & ~self.entered(closed)
        return [j for j in range(self.leaves) if not (closed >> j & 1 or self.inside[j] & aside)]

    def certain(self, closed: int) -> int:
        """Mask of the leaves of which it is known that they belong: they stand in no part but such as are under way."""
        if not self.parts:
            return self.mandatory
        others = ~self.entered(closed)
        return union(1 << leaf for leaf, within in enumerate(self.inside) if not within & others)

    @cached_property
    def spares(self) -> int:
        """Mask of the parts that are alternatives for which another one stands."""
        return union(1 << at for at, part in enumerate(self.parts) if part.is_spare)

    def belonging(self, entered: int) -> int:
        """The leaves of the plan when these parts were entered (right for all that is not closed)."""
        mask = self._belongs.get(entered)
        if mask is None:
            mask = self.expected
            for at in bits(entered):
                mask = mask & ~self.parts[at].instead | self.parts[at].own
            self._belongs[entered] = mask
        return mask


_CHAINS: dict[int, Chart] = {}


def draw_chart(root: Task) -> Chart:
    """The chart of a plan's tree (`Plan.chart` keeps it); plans without shapes share one for each length."""
    leaves = len(actions_below(root))
    if not is_plain(root):
        return _Drawing(leaves).chart(root)
    if leaves not in _CHAINS:
        everything = (1 << leaves) - 1
        before = tuple((1 << j) - 1 for j in range(leaves))
        _CHAINS[leaves] = Chart(leaves, before, (), (0,) * leaves, everything, everything)
    return _CHAINS[leaves]


class _Drawing:
    """Numbers the leaves of a tree from left to right, and its parts from the outside in."""

    def __init__(self, leaves: int) -> None:
        self.before, self.inside, self.count = [0] * leaves, [0] * leaves, 0
        self.parts: list[Part] = []
        self.leaves = (1 << leaves) - 1
        self.guards: list[tuple[int, int]] = []  # of each condition: what comes before (with conditions), its parts

    def chart(self, root: Node) -> Chart:
        """The chart of the tree."""
        _, expected = self.add(root, 0, 0)
        mandatory = union(1 << j for j, within in enumerate(self.inside) if within == 0)
        before, inside = tuple(mask & self.leaves for mask in self.before), tuple(self.inside)
        guards = tuple(self.guard(number) for number in range(len(self.guards)))
        return Chart(len(before), before, tuple(self.parts), inside, mandatory, expected, guards)

    def guard(self, number: int) -> Guard:
        """When the condition of this number is asked."""
        earlier, within = self.guards[number]
        bit = 1 << len(self.before) + number
        after = union(1 << j for j, mask in enumerate(self.before) if mask & bit)
        return Guard(earlier & self.leaves, after, within)

    def add(self, node: Node, earlier: int, within: int) -> tuple[int, int]:
        """Masks of the node's leaves, and of those that belong to the plan where the node does."""
        if isinstance(node, Action):
            self.before[self.count], self.inside[self.count] = earlier, within
            self.count += 1
            return 1 << self.count - 1, 1 << self.count - 1
        if isinstance(node, Condition):
            self.guards.append((earlier, within))
            return 1 << len(self.before) + len(self.guards) - 1, 0
        if isinstance(node, Shape) and node.kind == "choice":
            return self.choice(node, earlier, within)
        number = len(self.parts)
        is_part = isinstance(node, Shape) and node.kind == "optional"
        if is_part:
            self.parts.append(Part(0, 0))
            within |= 1 << number
        masks: list[int] = []
        expected = 0
        for child, needs in zip(node.children, children_before(node)):
            mask, belongs = self.add(child, earlier | union(masks[i] for i in needs), within)
            masks.append(mask)
            expected |= belongs
        if is_part:
            self.parts[number] = Part(union(masks) & self.leaves, expected)
        return union(masks), 0 if is_part else expected

    def choice(self, node: Shape, earlier: int, within: int) -> tuple[int, int]:
        """As `add`, for the alternatives of a choice."""
        found: list[tuple[int, int, int]] = []  # number of the part, its leaves, those that belong
        for child in node.children:
            number = len(self.parts)
            self.parts.append(Part(0, 0))
            found.append((number, *self.add(child, earlier, within | 1 << number)))
        first, _, smallest = min(found, key=lambda alternative: alternative[2].bit_count())
        everything = union(leaves for _, leaves, _ in found)
        for number, leaves, own in found:
            rivals = everything & ~leaves & self.leaves
            self.parts[number] = Part(leaves & self.leaves, own, rivals, smallest, number != first)
        return everything, smallest


def children_before(node: Node) -> list[set[int]]:
    """Per child the numbers of the children that come before it (an action has none)."""
    children = () if isinstance(node, (Action, Condition)) else node.children
    if not isinstance(node, Shape) or node.kind in ("sequence", "optional"):
        return [set(range(at)) for at in range(len(children))]
    needs: list[set[int]] = [set() for _ in children]
    for first, then in sorted(node.order, key=lambda pair: pair[1]):  # children stand in an order that fits
        needs[then] |= {first} | needs[first]
    return needs


def bits(mask: int) -> Iterator[int]:
    """The numbers of the bits that are set, from the lowest."""
    while mask:
        lowest = mask & -mask
        yield lowest.bit_length() - 1
        mask ^= lowest


def union(masks: Iterable[int]) -> int:
    """The leaves of any of the masks."""
    total = 0
    for mask in masks:
        total |= mask
    return total
