"""The contract between a day and the plans: how one instance of a goal goes on.

A day never sees a plan. It holds *states* of goal instances, hands them observations, and is told every state that
comes of it. Whoever implements this may enumerate plans (`engine.episodes.enumerated`) or grow them lazily.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Generic, NamedTuple, Protocol, TypeVar

from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.verification.observation import Seen
from casper.kb.terms.terms import Compound

if TYPE_CHECKING:
    import networkx as nx

S = TypeVar("S")  # hashable, equal up to the names of variables; states of different goals differ


class Step(NamedTuple, Generic[S]):
    """One way in which an instance takes an observation.

    ``missed`` are the leaves that must come before ``leaf`` and went unseen, ``weight`` is the likelihood of what the
    observation is taken for (1.0 when certain). ``is_theirs``: the plan itself says that this step is the agent's who
    took it (``by(Who, …)``), whoever's goal it is. ``settled`` are the arguments of the leaf that were parameters of
    which nothing was known: what they are is seen for the first time. ``part``: where `Growing.choices` counts several
    ways as one, since all begin with the same action, the chance of that one is shared out among them.
    """

    state: S
    missed: int
    leaf: Compound
    weight: float = 1.0
    is_theirs: bool = False
    settled: int = 0
    part: float = 1.0


class Taken(NamedTuple, Generic[S]):
    """An observation that an instance took: what it was taken for, and who did it."""

    step: Step[S]
    seen: Seen
    agent: str | None


class Growing(Protocol[S]):
    """How the instances of goals go on.

    States are frozen; every method but `observed`, `forget` and `fork` is a function of its arguments and of what was
    observed before (``did/2``).
    """

    @property
    def goals(self) -> Sequence[str]:
        """The goals' labels, in the author's order; a goal's number is its place here."""

    @property
    def looks_back(self) -> bool:
        """Whether what `steps` says may depend on what was observed before; otherwise it may be remembered."""

    def begins_with(self, seen: Seen) -> Iterable[int]:
        """The goals that may take the observation first, in order; a goal too many does no harm, one too few does."""

    def begin(self, goal: int) -> S:
        """The state of a goal of which nothing was seen."""

    def steps(self, state: S, seen: Seen, agent: str | None) -> Sequence[Step[S]]:
        """Every way in which the instance can take the observation.

        Leaves that must come before and were not seen count as missed, up to a number of them that the implementation
        states. Where two ways lead to equal states both are listed. It is asked often: it should be quick
        to say none.
        """

    def choices(self, state: S) -> int:
        """How many leaves could come next without a miss, optional ones too; at least 1 unless the instance is done."""

    def is_done(self, state: S) -> bool:
        """Whether nothing that is mandatory is left."""

    def least_left(self, state: S) -> int:
        """The fewest leaves that must still be done."""

    def rest(self, state: S) -> Sequence[Compound]:
        """A smallest rest in an order that the plan allows, bound as far as is known (the frontier)."""

    def goal_of(self, state: S) -> Compound:
        """The goal with its parameters as far as they are known."""

    def part(self, state: S, agent: str) -> CollaborativePlan | None:
        """What the agent can do of the rest, and what it waits for."""

    def tree(self, goal: int, history: Sequence[Taken[S]]) -> nx.DiGraph:
        """The marked plan tree of an instance that took these, in order (attributes: `casper.plans.trees.tree`)."""

    def reasons(self, state: S, seen: Seen, agent: str | None) -> Sequence[str]:
        """Why the instance cannot take the observation: names, order, parameters, a condition, who."""

    def leaves(self) -> Sequence[Compound]:
        """The actions of the plans, each once, with variables where parameters stand: for the nearest of an unknown."""

    def observed(self, seen: Seen, agent: str | None, t: float | None) -> None:
        """Told once an observation is settled: what is possible later may depend on it."""

    def forget(self) -> None:
        """Told when the last observation is taken back."""

    def fork(self) -> Growing[S]:
        """One with the same past that goes its own way."""
