"""Hypotheses of a day: which observations belong together, whose goal each such instance is, and what it may be.

A hypothesis says which observations serve the same goal instance and which are needless. *Which* goal that is, by which
leaves of its plan, is not settled by it: an instance holds every (goal, state) its observations fit, with their
probabilities. Given what belongs together instances are independent of each other, so nothing is lost by that, and
hypotheses that would differ only in what is not settled yet are one. Hypotheses whose open instances are equal are one
too, whatever came before; their weights add up.

How it came about is kept of the heaviest derivation only, for telling: what each instance took, the episodes that
closed, and what was needless.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, Literal, NamedTuple, TypeAlias, TypeVar

from casper.engine.episodes.growing import Step, Taken
from casper.engine.verification.observation import Seen
from casper.engine.verification.vocabulary import Foreign

S = TypeVar("S")
Outcome: TypeAlias = Literal["finished", "abandoned", "unclear"]


class Entry(NamedTuple, Generic[S]):
    """What an instance may be, and how likely: a goal, and where its plan stands."""

    goal: int
    state: S
    share: float


class Body(Generic[S]):
    """What a goal under way may be; compared by identity, since equal ones are made once.

    ``entries`` are sorted by share; the shares sum to 1. ``owner`` is the agent who began it, ``touched`` how many
    observations there had been of the owner when it last went on. ``is_done``: only optional leaves are left.
    """

    __slots__ = ("entries", "is_done", "owner", "touched")

    def __init__(self, entries: tuple[Entry[S], ...], owner: str | None, touched: int, is_done: bool) -> None:
        self.entries, self.owner, self.touched, self.is_done = entries, owner, touched, is_done


class Event(NamedTuple):
    """An observation with what it is known by: who did it, when, its number (from 1), and among the agent's own.

    ``only`` are the numbers of the goals it is known to serve; None: nothing is known.
    """

    seen: Seen
    agent: str | None
    t: float
    number: int
    own_number: int
    only: frozenset[int] | None = None


class Link(NamedTuple, Generic[S]):
    """What an instance took, from the latest observation back."""

    event: Event
    step: Step[S]
    before: Link[S] | None

    @property
    def number(self) -> int:
        """The number of the observation."""
        return self.event.number

    @property
    def taken(self) -> Taken[S]:
        """What was taken for what."""
        return Taken(self.step, self.event.seen, self.event.agent)

    def all(self) -> list[Link[S]]:
        """From the first to this one."""
        links: list[Link[S]] = []
        link: Link[S] | None = self
        while link is not None:
            links.append(link)
            link = link.before
        return links[::-1]


class Instance(Generic[S]):
    """A goal under way, and for each of its body's entries how it came there."""

    __slots__ = ("body", "links")

    def __init__(self, body: Body[S], links: tuple[Link[S], ...]) -> None:
        self.body, self.links = body, links


class Closed(NamedTuple, Generic[S]):
    """An instance that is over, what became of it, and how many leaves were still to be done.

    ``number`` is that of the observation after which it closed, ``sure`` how likely its hypothesis takes it for this.
    """

    goal: int
    owner: str | None
    outcome: Outcome
    link: Link[S]
    left: int
    number: int
    sure: float

    @property
    def key(self) -> tuple[int, str | None, str, int]:
        """Equal for what need not be told apart: the goal, whose it is, what became of it, where it ended."""
        return self.goal, self.owner, self.outcome, self.link.number


Key: TypeAlias = "tuple[Body[S], ...]"  # the open instances in the order in which they were last touched


class Hypothesis(NamedTuple, Generic[S]):
    """Open instances, their weight over all derivations, and the heaviest one's weight and story."""

    instances: tuple[Instance[S], ...]
    weight: float
    best: float
    closed: tuple[Closed[S], ...] = ()  # lately, and not told yet
    needless: tuple[int, ...] = ()  # numbers of observations, lately

    @property
    def key(self) -> Key[S]:
        """What it is equal by."""
        return tuple([instance.body for instance in self.instances])


@dataclass(frozen=True)
class Level(Generic[S]):
    """What is believed after an observation.

    ``hypotheses`` are sorted by weight; the weights sum to 1. ``counts`` are the observations of each agent so far.
    ``current`` is each goal's share of what the last observation was taken for. ``dropped`` is the share of the weight
    that was dropped with this observation, ``told`` the episodes that all agree on, lately, and ``settled`` those of
    them that this observation settled. ``foreign``: why no plan has the action, where none has.
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
    foreign: Foreign | None = None


def nothing() -> Level[S]:
    """What is believed before anything was seen."""
    return Level((Hypothesis((), 1.0, 1.0),), 0, {})
