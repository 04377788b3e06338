"""How a domain is shown to a person: who is watched, who helps, what they may be after, what can be done."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Sized
from pathlib import Path
from typing import Protocol

from casper.kb.text.lines import Line, Span, line, one_line

MOST = 20  # goals or actions that are named


class Holds(Protocol):
    """What is printed of a domain (`engine.domain.domain`)."""

    @property
    def name(self) -> str:
        """What it is called."""

    @property
    def folder(self) -> Path:
        """Where it was read from."""

    @property
    def kb(self) -> Sized:
        """Its clauses."""

    @property
    def library(self) -> Plans:
        """Its plans."""

    @property
    def verifies(self) -> bool:
        """Whether it has an ontology."""

    @property
    def partner(self) -> str:
        """Who is watched."""

    @property
    def robot(self) -> str:
        """Who helps."""


class Plans(Protocol):
    """What is printed of the plans."""

    @property
    def goals(self) -> Sequence[str]:
        """The labels of the goals."""

    @property
    def actions(self) -> Iterable[tuple[str, int]]:
        """Names and arities of the actions."""


def domain_lines(domain: Holds) -> Iterator[Line]:
    """What there is in it, a line for each kind."""
    helps = ", and helps" if domain.verifies else ""
    yield line(Span(domain.name, "strong"), f": {domain.robot} watches {domain.partner}{helps}")
    yield line(_named("goal", domain.library.goals))
    yield line(_named("action", [f"{name}/{arity}" for name, arity in domain.library.actions]))
    verifies = "" if domain.verifies else "; it has no ontology.pl, and verifies nothing"
    yield line(f"{_counted(len(domain.kb), 'clause')} of {domain.folder}{verifies}")


def domain_name(domain: Holds) -> str:
    """One line that tells it from others: ``<Domain kitchen: 3 goals, 342 clauses>``."""
    goals, clauses = len(domain.library.goals), len(domain.kb)
    return one_line(f"Domain {domain.name}: {_counted(goals, 'goal')}, {_counted(clauses, 'clause')}")


def _named(kind: str, names: Sequence[str]) -> str:
    more = [f"and {len(names) - MOST} more"] if len(names) > MOST else []
    shown = ", ".join([*names[:MOST], *more])
    return f"{_counted(len(names), kind)}: {shown}" if names else f"no {kind}s"


def _counted(count: int, kind: str) -> str:
    return f"{count} {kind}{'' if count == 1 else 's'}"
