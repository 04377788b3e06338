"""Hypotheses of a day: which goal instances are open, who began them, and how each came where it is.

A hypothesis *is* its open instances; equal ones are one, and their weights add up. How it came about is kept of the
heaviest derivation only, for telling: the observations that each instance took, the episodes that closed, and what was
needless.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, Literal, NamedTuple, TypeAlias, TypeVar

from casper.engine.episodes.growing import Taken
from casper.engine.verification.observation import Seen

S = TypeVar("S")
Outcome: TypeAlias = Literal["finished", "abandoned", "unclear"]


class Instance(Generic[S]):
    """A goal under way; compared by identity, since equal ones are made once.

    ``owner`` is the agent who began it, ``touched`` how many observations there had been of the owner when it last went
    on.
    """

    __slots__ = ("goal", "is_done", "owner", "state", "touched")

    def __init__(self, goal: int, state: S, owner: str | None, touched: int, is_done: bool) -> None:
        self.goal, self.state, self.owner, self.touched, self.is_done = goal, state, owner, touched, is_done


class Link(NamedTuple, Generic[S]):
    """What an instance took, from the latest observation back."""

    number: int  # of the observation, from 1
    t: float
    taken: Taken[S]
    before: Link[S] | None

    def all(self) -> list[Link[S]]:
        """From the first to this one."""
        links: list[Link[S]] = []
        link: Link[S] | None = self
        while link is not None:
            links.append(link)
            link = link.before
        return links[::-1]


class Closed(NamedTuple, Generic[S]):
    """An instance that is over, what became of it, and how many leaves were still to be done."""

    goal: int
    owner: str | None
    outcome: Outcome
    link: Link[S]
    left: int
    number: int  # of the observation after which it closed

    @property
    def key(self) -> tuple[int, str | None, str, int]:
        """Equal for what need not be told apart: the goal, whose it is, what became of it, where it ended."""
        return self.goal, self.owner, self.outcome, self.link.number


Key: TypeAlias = "tuple[Instance[S], ...]"  # the instances in the order in which they were last touched


class Hypothesis(NamedTuple, Generic[S]):
    """Open instances, their weight over all derivations, and the heaviest one's weight and story."""

    instances: Key[S]
    weight: float
    best: float
    links: tuple[Link[S], ...]  # of each instance
    closed: tuple[Closed[S], ...] = ()  # lately, and not told yet
    needless: tuple[int, ...] = ()  # numbers of observations, lately
    last: int | None = None  # the goal of the last observation


@dataclass(frozen=True)
class Level(Generic[S]):
    """What is believed after an observation.

    ``hypotheses`` are sorted by weight; the weights sum to 1. ``counts`` are the observations of each agent so far.
    ``current`` is each goal's share of what the last observation was taken for. ``dropped`` is the share of the weight
    that was dropped with this observation, ``told`` the episodes that all agree on, lately, and ``settled`` those of
    them that this observation settled.
    """

    hypotheses: Sequence[Hypothesis[S]]
    number: int
    counts: Mapping[str | None, int]
    seen: Seen | None = None
    agent: str | None = None
    t: float = 0.0
    current: Mapping[int, float] | None = None
    dropped: float = 0.0
    told: tuple[Closed[S], ...] = ()
    settled: tuple[Closed[S], ...] = ()
    nearest: str | None = None  # of an action that no plan has: the one that is meant, perhaps
    why: tuple[str, ...] = ()


def nothing() -> Level[S]:
    """What is believed before anything was seen."""
    return Level((Hypothesis((), 1.0, 1.0, ()),), 0, {})


def instances_of(levels: Sequence[Level[S]]) -> Iterator[Instance[S]]:
    """Every instance that is kept."""
    for level in levels:
        for hypothesis in level.hypotheses:
            yield from hypothesis.instances
