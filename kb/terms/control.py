"""Names of conditions that are made of other conditions."""

from __future__ import annotations

CONTROL: frozenset[tuple[str, int]] = frozenset(
    {
        (",", 1),
        (",", 2),
        (";", 2),
        ("->", 2),
        ("\\+", 1),
        ("not", 1),
        ("true", 0),
        ("fail", 0),
        ("false", 0),
        ("forall", 2),
        ("findall", 3),
        ("aggregate_all", 3),
    }
)
