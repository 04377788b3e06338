"""The relations of a domain that the system itself reads (docs/language.md), by name and arity."""

from __future__ import annotations

from casper.kb.reasons.says import SAYS

SCENE_RELATIONS = frozenset(
    {
        ("body", 2), ("start", 4), ("room_size", 2), ("outline", 3), ("walkable", 3), ("hole", 5), ("furniture", 4),
        ("furniture", 6), ("furniture", 7), ("shelf", 2), ("opens", 2), ("position", 2), ("position", 3),
        ("position", 4), ("shape", 2), ("shape", 5), ("mass", 2), ("placing", 2), ("consumes", 1), ("colour", 4),
    }
)  # fmt: skip
"""Relations of the room (docs/rooms.md)."""

SHARING_NAMES = SCENE_RELATIONS | {
    ("setting", 3),
    # from perception to action
    ("band", 2), ("encoding", 3), ("movement", 5), ("movement", 10), ("likelihood", 3), ("emission", 3),
    ("lasts", 3),
    ("transition", 4), ("cycle", 3), ("loop", 1), ("start", 3), ("context", 3),
}  # fmt: skip
"""Relations of the stages: an ontology may have a furniture/1 beside the scene's furniture/7."""

SYSTEM_RELATIONS = SHARING_NAMES | {("goal", 1), ("human", 1), ("robot", 1), ("prior", 2), *SAYS}
"""Every relation that is asked for by name."""

SECTIONS = (
    "actions", "agents", "collaboration", "focus", "human", "memory", "perception", "plans", "robot", "sensor", "sim",
    "tracking",
    "verification",
)  # fmt: skip
"""Whom ``setting(Section, Name, Value)`` can be for."""
