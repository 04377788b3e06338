"""Series of bounded length: of what is too much for a page every second one goes, evenly over the whole time."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Generic, TypeVar

Item = TypeVar("Item")


class Thinned(Generic[Item]):
    """At most ``most`` of the items that are added, evenly spread: each ``stride``-th, the first among them."""

    def __init__(self, most: int) -> None:
        self.most, self.stride, self.count = max(2, most), 1, 0
        self._items: list[Item] = []

    def add(self, item: Item) -> None:
        """One more."""
        if self.count % self.stride == 0:
            self._items.append(item)
            if len(self._items) > self.most:
                del self._items[1::2]
                self.stride *= 2
        self.count += 1

    @property
    def left_out(self) -> int:
        """How many are not kept."""
        return self.count - len(self._items)

    def __iter__(self) -> Iterator[Item]:
        return iter(self._items)

    def __len__(self) -> int:
        return len(self._items)
