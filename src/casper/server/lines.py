"""Lines of bounded length from a stream: one that is longer is skipped without being kept."""

from __future__ import annotations

from collections.abc import Iterator
from typing import BinaryIO


def bounded_lines(stream: BinaryIO, most: int) -> Iterator[bytes | None]:
    """Each line without its end, blank ones left out; None stands for one of more than ``most`` bytes.

    The last line may lack its end: what there is of it is given, since it may be whole.
    """
    while line := stream.readline(most + 1):
        if len(line) > most and not line.endswith(b"\n"):
            while line and not line.endswith(b"\n"):
                line = stream.readline(1 << 16)
            yield None
        elif line := line.strip():
            yield line
