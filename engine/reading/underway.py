"""An episode under way: what a partner does for one goal, as it is read so far, and the robot's part in it."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import Any

from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.reading.reading import Reading
from casper.engine.verification.observation import Seen
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import as_term

FINISHED, ABANDONED, UNCLEAR = "finished", "abandoned", "unclear"
"""How an episode ends: all was seen or the robot's part done; given up for another goal; nobody knows."""


@dataclass(slots=True)
class Underway:
    """A reading of what belongs to the episode, its supervisor, and when its first and last action were seen (s)."""

    reading: Reading
    supervisor: Supervisor
    begun: float | None = None
    last: float = 0.0
    instead_of: Underway | None = None  # the episode that its first action seemed to end
    numbers: set[int] = field(default_factory=set)  # of its observations since the day began, where somebody counts

    def read_anew(self, reading: Reading, numbers: set[int]) -> None:
        """Other observations belong to it than was thought; what the supervisor holds to stays."""
        self.reading, self.supervisor.reading, self.numbers = reading, reading, numbers

    @property
    def goal(self) -> str | None:
        """The goal that is committed to, else the one that the best explanation has before all others."""
        if self.supervisor.commitment is not None:
            return self.supervisor.commitment.goal
        shares = sorted(self.reading.posterior.items(), key=lambda pair: -pair[1])
        clear = len(shares) == 1 or (len(shares) > 1 and shares[0][1] > shares[1][1])
        return shares[0][0] if clear and shares[0][1] > 0 else None

    @property
    def explanation(self) -> Explanation | Interleaved | None:
        """The best explanation of its goal."""
        return None if self.goal is None else self.reading.best_of(self.goal)

    @property
    def is_complete(self) -> bool:
        """Whether nothing that must be done is left of its goal, which is committed to."""
        found = self.explanation
        return (
            self.supervisor.commitment is not None
            and found is not None
            and not any(part.situation.belonging for part in found.parts)
        )

    @property
    def is_over(self) -> bool:
        """Whether it is complete by every explanation, so that no further action can belong to it.

        Where actions may be needless nothing is ever so sure: then it is over when that is likelier than not.
        """
        if not self.is_complete:
            return False
        coming = self.reading.next_actions
        return set(coming) <= {None} if self.reading.options.noise is None else coming.get(None, 0.0) > 0.5

    @property
    def outcome(self) -> str:
        """How it ends when the partner goes over to something else now."""
        if self.is_complete:
            return FINISHED
        return UNCLEAR if self.supervisor.commitment is None or self.supervisor.given_up else ABANDONED

    def contains(self, seen: Seen) -> bool:
        """Whether the best explanation's plan has the very action, whether or not it can come now."""
        found = self.explanation
        leaves = () if found is None else (leaf for part in found.parts for leaf in part.leaves)
        return any(term_text(as_term(leaf)) == str(seen) or leaf.functor == str(seen) for leaf in leaves)

    def note(self, t: float) -> None:
        """Its last action was seen then."""
        self.begun = t if self.begun is None else self.begun
        self.last = t

    def row(self, agent: str, outcome: str, t: float) -> dict[str, Any]:
        """The data of its ``episode`` event when it ends at ``t``."""
        found = self.explanation
        observed, missed = (0, 0) if found is None else (len(found.marks), found.missed)
        told = {"agent": agent, "goal": self.goal, "outcome": outcome, "from": self.begun, "to": t}
        return {**told, "observed": observed, "missed": missed}
