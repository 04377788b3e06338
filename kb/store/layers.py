"""Rows and base facts of a model that is laid over another: each predicate gets its layer when it is looked up."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, MutableMapping

from casper.kb.relations.relation import Row
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.origins import Origin


class Layers(dict):  # type: ignore[type-arg]
    """A mapping laid over another: an entry gets a layer of its own when it is first looked up."""

    def __init__(self, below: Mapping, layer: type) -> None:  # type: ignore[type-arg]
        super().__init__()
        self.below, self.layer = below, layer

    def __missing__(self, key: Indicator) -> object:
        return self.setdefault(key, self.layer(self.below[key]))  # of two threads that look, the first one's counts

    def get(self, key: Indicator, default: object = None) -> object:
        """The entry, through its layer."""
        try:
            return self[key]
        except KeyError:
            return default

    def __contains__(self, key: object) -> bool:
        return super().__contains__(key) or key in self.below

    def __iter__(self) -> Iterator[Indicator]:
        return iter(dict.fromkeys((*self.below, *super().__iter__())))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def values(self) -> list[object]:  # type: ignore[override]
        """Every entry, through its layer."""
        return [self[key] for key in self]


class GivenLayer(MutableMapping[Row, "Origin"]):
    """Base facts laid over others."""

    def __init__(self, below: Mapping[Row, Origin]) -> None:
        self.below = below
        self.above: dict[Row, Origin] = {}
        self.gone: set[Row] = set()

    def __contains__(self, row: object) -> bool:
        return row in self.above or (row in self.below and row not in self.gone)

    def __getitem__(self, row: Row) -> Origin:
        if row in self.above:
            return self.above[row]
        if row in self.gone:
            raise KeyError(row)
        return self.below[row]

    def __setitem__(self, row: Row, clause: Origin) -> None:
        self.above[row] = clause

    def __delitem__(self, row: Row) -> None:
        self.above.pop(row, None)
        self.gone.add(row)

    def __iter__(self) -> Iterator[Row]:
        yield from (row for row in self.below if row not in self.gone and row not in self.above)
        yield from self.above

    def __len__(self) -> int:
        return sum(1 for _ in self)
