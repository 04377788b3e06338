"""What came of a comparison."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass
class Tally:
    """How many were asked, how many were answered exactly alike, and the others.

    ``left`` are those that SWI-Prolog ends with an error; ``undefined`` those in which something is undefined.
    """

    asked: int
    equal: int = 0
    left: int = 0
    undefined: int = 0
    disagreements: list[str] = field(default_factory=list)
