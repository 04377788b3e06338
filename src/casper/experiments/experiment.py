"""What an experiment is: how it is worked out, how its data are drawn, and what is said of them on a page."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import Any, TypeAlias

from casper.engine.domain.domain import Domain
from casper.sim_adapter.room.scene import BODY

Row: TypeAlias = dict[str, Any]
Trial: TypeAlias = Mapping[str, Any]
"""Fields of `TrialSettings` that are not its defaults, and perhaps ``settings`` (`casper.batch.run_trials`)."""


@dataclass(frozen=True, slots=True)
class Asked:
    """What is asked of an experiment.

    ``trials`` is how many there are, of each condition where there are several; None: as many as the experiment takes
    by itself. ``seed`` is the first one, ``body`` the simulated robot's.
    """

    domain: Domain
    trials: int | None = None
    seed: int = 0
    body: str = BODY

    def count(self, usual: int) -> int:
        """How many trials: those asked for, or as many as usual."""
        return usual if self.trials is None else self.trials

    @property
    def first(self) -> dict[str, Any]:
        """What is told of every experiment with trials: the first seed, and the body where it is another one."""
        return {"first seed": self.seed, **({} if self.body == BODY else {"robot": self.body})}


@dataclass(frozen=True, slots=True)
class Data:
    """What an experiment found: all its figures and its page are made of this alone.

    Attributes:
        name: of the experiment.
        about: what was asked, in a few words each: ``{"trials": 15, "first seed": 0}``.
        summary: a row for each condition, as it is printed.
        rows: the tidy table, one observation a row.
        facts: what else figures need: names, curves, trees, a room.
    """

    name: str
    about: Mapping[str, Any]
    summary: Sequence[Row]
    rows: Sequence[Row]
    facts: Mapping[str, Any] = field(default_factory=dict)

    def to_json(self) -> dict[str, Any]:
        """All of it."""
        return {
            "experiment": self.name,
            "about": dict(self.about),
            "summary": list(self.summary),
            "rows": list(self.rows),
            "facts": dict(self.facts),
        }

    @classmethod
    def from_json(cls, told: Mapping[str, Any]) -> Data:
        """What `to_json` gave.

        Raises:
            KeyError: a part is missing.
        """
        return cls(told["experiment"], told["about"], told["summary"], told["rows"], told["facts"])


Ran: TypeAlias = Callable[[Sequence[Trial]], list[dict[str, Any]]]
"""Runs trials, or takes those that were run already: what became of each (`casper.batch.run_trials`)."""


@dataclass(frozen=True, slots=True)
class Experiment:
    """One of them.

    Attributes:
        name: by which it is called.
        shows: a line about it.
        paper: the table or figure of the paper; empty where it has none.
        work: works it out.
        says: its part of a page, as Markdown: the paper's number, ours, the reason for a difference.
        figures: what draws each of its figures, by the figure's name.
        trials: all that it will ask for, so that several experiments can share one run.
        needs: libraries, with the extra that brings each; matplotlib, and MuJoCo where there are trials, go without
            saying.
    """

    name: str
    shows: str
    paper: str
    work: Callable[[Asked, Ran], Data]
    says: Callable[[Data], Iterable[str]]
    figures: Mapping[str, Callable[[Data], Any]] = field(default_factory=dict)
    trials: Callable[[Asked], Sequence[Trial]] = lambda asked: ()
    needs: Mapping[str, str] = field(default_factory=dict)


def table(header: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    """A Markdown table; numbers are put to the right."""
    found = [[shown(cell) for cell in row] for row in rows]
    lines = [f"| {' | '.join(header)} |", "|" + "---|" * len(header)]
    return "\n".join([*lines, *(f"| {' | '.join(row)} |" for row in found)])


def shown(value: Any) -> str:
    """A value as a person is shown it: two decimals at most, a dash for what is not there."""
    if value is None:
        return "–"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:.2f}".rstrip("0").rstrip(".") if value != int(value) else f"{value:.0f}"
    return str(value)
