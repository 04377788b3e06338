"""A graph of premises as an outline of bounded size: every shared part once, and a count of what is left out.

Works on anything that has ``premises``. Only loops, no recursion: a proof may be far deeper than Python's stack.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import dataclass
from itertools import count
from typing import Generic, Protocol, Self, TypeVar


class Node(Protocol):
    """What rests on premises."""

    @property
    def premises(self) -> Sequence[Self]:
        """What it rests on."""


N = TypeVar("N", bound=Node)


@dataclass(frozen=True, slots=True)
class Entry(Generic[N]):
    """A line of an outline.

    ``depth`` counts from 0 and ``last`` tells the last premise of its parent. ``label`` numbers a part that is used
    more than once (0: it is not); ``above`` says that its premises were shown where the label first stood, ``cut`` that
    they lie deeper than the outline goes.
    """

    node: N
    depth: int
    last: bool
    label: int
    above: bool
    cut: bool


@dataclass(frozen=True, slots=True)
class Outline(Generic[N]):
    """Entries in the author's order, a node before its premises, and how many different nodes none of them shows."""

    entries: tuple[Entry[N], ...]
    more: int

    @property
    def closing(self) -> str:
        """The line that says what is left out; empty when nothing is."""
        return f"… {self.more:,} more step{'' if self.more == 1 else 's'}" if self.more else ""


def premises_first(root: N) -> Iterator[N]:
    """Every node once, premises before what rests on them."""
    seen: set[int] = set()
    waiting = [root]
    while waiting:
        node = waiting[-1]
        missing = [premise for premise in node.premises if id(premise) not in seen]
        if missing:
            waiting.extend(missing)
            continue
        waiting.pop()
        if id(node) not in seen:
            seen.add(id(node))
            yield node


Numbers = dict[Hashable, int]


def numbered(root: N, content: Callable[[N], Hashable], known: Numbers) -> dict[int, int]:
    """For the ``id`` of every node a number: the same for nodes of equal content that rest on the same numbers.

    ``known`` is filled as numbers are given; handed in again it makes the numbers of two graphs comparable.
    """
    numbers: dict[int, int] = {}
    for node in premises_first(root):
        key = (content(node), tuple([numbers[id(premise)] for premise in node.premises]))
        numbers[id(node)] = known.setdefault(key, len(known))
    return numbers


def outline(root: N, numbers: dict[int, int], most: int, deepest: int) -> Outline[N]:
    """The outline of at most ``most`` entries, none deeper than ``deepest``; ``numbers`` as `numbered` gives them."""
    uses = Counter(n for node in _different(root, numbers) for n in _numbers_of(node, numbers))
    entries: list[Entry[N]] = []
    labels: dict[int, int] = {}  # of what was shown with its premises
    fresh = count(1)
    shown: set[int] = set()
    waiting = [(root, 0, True)]
    while waiting and len(entries) < most:
        node, depth, last = waiting.pop()
        number = numbers[id(node)]
        shown.add(number)
        above = bool(node.premises) and number in labels
        cut = bool(node.premises) and not above and depth == deepest
        if node.premises and not above and not cut:
            labels[number] = next(fresh) if uses[number] > 1 else 0
            places = reversed(list(enumerate(node.premises, 1)))
            waiting.extend((premise, depth + 1, at == len(node.premises)) for at, premise in places)
        entries.append(Entry(node, depth, last, labels.get(number, 0), above, cut))
    return Outline(tuple(entries), len(set(numbers.values())) - len(shown))


def _different(root: N, numbers: dict[int, int]) -> Iterator[N]:
    """One node of each number."""
    seen: set[int] = set()
    for node in premises_first(root):
        if numbers[id(node)] not in seen:
            seen.add(numbers[id(node)])
            yield node


def _numbers_of(node: N, numbers: dict[int, int]) -> list[int]:
    return [numbers[id(premise)] for premise in node.premises]
