"""What the robot believes in: a goal since a time, with the explanation that speaks for it and its own part."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.explanation.situation import Situation

NOTHING = {"predicted": None, "prediction_time": None, "observed": 0, "missed": 0, "waiting": 0, "planned": 0}
"""The figures where nothing was predicted."""


@dataclass(frozen=True, slots=True)
class Commitment:
    """The goal the robot believes in: since when, from which explanation, and its part in it."""

    goal: str
    t: float
    explanation: Explanation | Interleaved
    plan: CollaborativePlan
    observations: int  # that had been made by then

    def figures(self) -> dict[str, Any]:
        """Those of the prediction, at the moment it was made (paper table "results")."""
        return {
            "predicted": self.goal,
            "prediction_time": self.t,
            "observed": len(self.explanation.marks),
            "missed": self.explanation.missed,
            "waiting": len(self.plan.waiting),
            "planned": len(self.plan.actions),
        }


def where(explanation: Explanation | Interleaved, plan: CollaborativePlan) -> Situation | None:
    """Where the plan stands that the robot's part belongs to."""
    return next((part.situation for part in explanation.parts if part.goal == plan.goal), None)
