"""What a decision policy looks at."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Standing:
    """What a policy looks at: the best explanation and its rivals."""

    explanations: int  # how many there are
    best_goal: str | None
    best_missed: int
    rivals: int  # explanations of other goals that weigh as much as the best
    ties: int = 1  # explanations that weigh as much as the best, itself among them
