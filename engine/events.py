"""Events: every hand-over in the mind, as frozen data that can be logged, replayed and shown."""

from __future__ import annotations

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

TYPES = (
    "focus",
    "movement",
    "action",
    "verdict",
    "reading",
    "prediction",
    "plan",
    "robot",
    "warning",
    "summary",
)


@dataclass(frozen=True, slots=True)
class Event:
    """One thing that happened: its type (one of `TYPES`), when (seconds), and what."""

    type: str
    t: float
    data: Mapping[str, Any] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """The design's object: ``{"type": …, "t": …, **data}``."""
        return {"type": self.type, "t": self.t, **self.data}

    def __str__(self) -> str:
        return json.dumps(self.to_json(), ensure_ascii=False)
