"""What lies between two states of QTC that cannot follow each other."""

from __future__ import annotations


def between(earlier: str, later: str) -> str | None:
    """The state of QTC that lies between two, or None where the one may follow the other at once.

    A symbol does not go from ``-`` to ``+`` without being 0; and while one symbol becomes 0 another cannot leave it,
    since 0 holds at the moment of the change (dominance; Galton 2000, Delafontaine et al. 2011).
    """
    changed = [(a, b) for a, b in zip(earlier, later) if a != b]
    if all(b == "0" for _, b in changed) or all(a == "0" for a, _ in changed):
        return None
    return "".join(a if a == b else "0" for a, b in zip(earlier, later))
