"""Exact sums of counts in arrays (numpy)."""

from __future__ import annotations

from typing import Any


def exactly(np: Any, counts: Any) -> int:
    """The sum as a Python integer: it may not fit into 64 bits, though every count does.

    Args:
        np: numpy; it is imported when the first large library is read.
        counts: an array of integers of any width, none negative, or of Python's.
    """
    if counts.dtype.kind == "O":
        return int(counts.sum())
    if counts.dtype.itemsize < 8:
        return int(counts.sum(dtype=np.uint64))
    return (int((counts >> 32).sum()) << 32) + int((counts & 0xFFFFFFFF).sum())
