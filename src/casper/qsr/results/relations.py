"""The relations of a trace: codes by calculus, with who is related, the labels and the times."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from casper.kb.errors import TraceError
from casper.qsr.arrays.scene import Array
from casper.qsr.traces.checking import shown

if TYPE_CHECKING:
    import pandas as pd


@dataclass(frozen=True, eq=False)
class Column:
    """The relations of one calculus.

    labels: by code. of: the tuples of names that are related. t: (T,) seconds. codes: (tuples, T) integers, -1 where a
    relation is undefined: somebody is missing, or for motion was missing a step before.
    """

    calculus: str
    labels: tuple[str, ...]
    of: tuple[tuple[str, ...], ...]
    t: Array
    codes: Array

    def between(self, *names: str) -> Array:
        """The labels of one tuple at all steps, None where undefined.

        Raises:
            TraceError: these are not related here.
        """
        if names not in self.of:
            some = shown([" ".join(row) for row in self.of[:9]])
            raise TraceError(f"{' '.join(names)} is not related by {self.calculus} here; there are {some}")
        return np.asarray(self.words()[self.codes[self.of.index(names)]])

    def labelled(self) -> Array:
        """All labels, (tuples, T), None where undefined."""
        return np.asarray(self.words()[self.codes])

    def words(self) -> Array:
        """Labels by code, None at the end, where -1 finds it."""
        words = np.empty(len(self.labels) + 1, dtype=object)
        words[:-1] = self.labels
        return words

    def at(self, step: int) -> dict[tuple[str, ...], str]:
        """What holds at one step, as `casper.qsr.Stream` tells it."""
        codes = self.codes[:, step].tolist()
        return {row: self.labels[code] for row, code in zip(self.of, codes, strict=True) if code >= 0}

    def __repr__(self) -> str:
        return f"<{self.calculus} of {len(self.of)} tuples at {len(self.t)} steps>"


@dataclass(frozen=True, eq=False)
class Relations(Mapping[str, Column]):
    """The columns by the names of their calculi; ``t`` are the times (seconds)."""

    t: Array
    columns: Mapping[str, Column]

    def __getitem__(self, name: str) -> Column:
        if name not in self.columns:
            raise TraceError(f"{name} was not worked out; there are {', '.join(self.columns)}")
        return self.columns[name]

    def __contains__(self, name: object) -> bool:
        return name in self.columns

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        return len(self.columns)

    def at(self, step: int) -> dict[str, dict[tuple[str, ...], str]]:
        """What holds at one step in every calculus, as `casper.qsr.Stream.update` gives it."""
        return {name: column.at(step) for name, column in self.columns.items()}

    def rows(self) -> Iterator[dict[str, Any]]:
        """One row for each relation that holds at each step: ``t``, ``calculus``, ``relation``, ``a``, ``b``, ``c``."""
        for name, column in self.columns.items():
            for row, codes in zip(column.of, column.codes.tolist(), strict=True):
                who = dict(zip("abc", row))
                for t, code in zip(self.t.tolist(), codes, strict=True):
                    if code >= 0:
                        yield {"t": t, "calculus": name, "relation": column.labels[code], **who}

    def to_pandas(self) -> pd.DataFrame:
        """The rows as a data frame, in the order of time (needs ``casper-hri[tables]``)."""
        import pandas as pd

        names = ["t", "calculus", "relation", *"abc"[: max((len(c.of[0]) for c in self.values() if c.of), default=1)]]
        return pd.DataFrame(list(self.rows()), columns=names).sort_values("t", kind="stable", ignore_index=True)

    def __repr__(self) -> str:
        return f"<Relations at {len(self.t)} steps: {', '.join(map(repr, self.columns.values()))}>"
