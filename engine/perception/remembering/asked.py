"""What was seen, as relations that rules ask for: what is not known is undefined, never a silent no.

``qdc(T, A, O, Band)``, ``qtc(T, A, O, toward)``, ``mos(T, A, moving)`` and ``hold(T, A, O)`` are known at the steps
that are remembered. Of any other time, of an agent nobody watches and of a thing that was not seen they are undefined,
and so are episodes, ``during(qdc(A, O, Band), From, To)``, that would lie where nothing was seen. A variable runs over
who is watched and what was seen.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from itertools import product
from typing import Any

from casper.engine.perception.perception import Relations
from casper.engine.perception.remembering.memory import ARITIES, Kind, MemorySettings, SensoryMemory, kind_of
from casper.kb.base import KnowledgeBase
from casper.kb.relations.relation import Relation, Row
from casper.kb.relations.undefined import UndefinedRows, wholly_unknown
from casper.kb.terms.clauses import Indicator
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import is_ground
from casper.kb.terms.unknown import UNKNOWN, closed
from casper.kb.terms.values.moments import Moment, sometime
from casper.kb.top_down.linking import Rows

DURING: Indicator = ("during", 3)
ASKED: tuple[Indicator, ...] = (*ARITIES.items(), DURING)
"""The relations that a knowledge base is offered (`KnowledgeBase.offer`)."""
Given = Mapping[str, SensoryMemory]
_ALL_UNKNOWN: Any = UNKNOWN


class Memories:
    """What was seen of all agents who are watched, in one world.

        >>> kb.offer(ASKED)                                  # a Domain has done that
        >>> memories.update("human", world.t, relations)     # step after step
        >>> memories.known(kb).query("during(hold(human, cup), From, To)")
    """

    def __init__(self, settings: MemorySettings | None = None) -> None:
        self.settings = settings or MemorySettings()
        self.of: dict[str, SensoryMemory] = {}

    def update(self, agent: str, t: float, relations: Relations | None) -> None:
        """Take in what was seen of one agent at ``t`` (seconds); None: nothing."""
        if agent not in self.of:
            if relations is None:
                return
            self.of[agent] = SensoryMemory(self.settings.steps, self.settings.episodes)
        self.of[agent].update(t, relations)

    def known(self, kb: KnowledgeBase) -> KnowledgeBase:
        """The knowledge base with what is remembered now, as a view: ``kb`` stays as it is."""
        return kb.seeing(answers(self.of))


def answers(memories: Given) -> dict[Indicator, Rows]:
    """Who answers each of the relations, for `KnowledgeBase.seeing`."""
    told: dict[Indicator, Rows] = {i: Rows(lambda atom: _at_steps(atom, memories), "seen") for i in ARITIES.items()}
    return {**told, DURING: Rows(lambda atom: _episodes(atom, memories), "seen")}


def _relation(indicator: Indicator, rows: Iterable[Row], undefined: Iterable[Row]) -> Relation:
    found = Relation(*indicator, rows)
    doubtful = [row for row in undefined if row not in found]
    if doubtful:
        found.undefined = UndefinedRows(*indicator, doubtful)
    return found


def _watched(agent: Term, memories: Given) -> Mapping[str, SensoryMemory] | None:
    """The memories an atom asks for; None: of somebody nobody watches."""
    if isinstance(agent, Variable):
        return memories
    return {agent: memories[agent]} if isinstance(agent, str) and agent in memories else None


def _kinds(name: str, rest: tuple[Term, ...], memory: SensoryMemory) -> list[Kind]:
    """Of what an atom asks, by what stands behind its agent; a thing that was never seen is a kind, too."""
    if ARITIES[name] == 3:
        return [(name,)]
    return memory.kinds(name) if not is_ground(rest[0]) else [(name, str(rest[0]))]


# --- the last steps -----------------------------------------------------------------------------------------------


def _at_steps(atom: Compound, memories: Given) -> Relation:
    t, agent, *rest = atom.args
    found = _watched(agent, memories)
    if found is None:
        return wholly_unknown(atom.indicator)
    rows: list[Row] = []
    doubtful: list[Row] = []
    for name, memory in found.items():
        kinds = _kinds(atom.functor, tuple(rest), memory)
        wanted = {kind[1] for kind in kinds if len(kind) > 1}
        for step in memory.steps if isinstance(t, Variable) else (s for s in memory.steps if s.t == t):
            said = (s for s in step.said if s[0] == atom.functor and (not wanted or s[2] in wanted))
            rows.extend((step.t, *s[1:]) for s in said)
        for kind in kinds:
            doubtful.extend((when, name, *kind[1:], _ALL_UNKNOWN) for when in _doubtful_times(t, kind, memory))
    return _relation(atom.indicator, rows, doubtful)


def _doubtful_times(t: Term, kind: Kind, memory: SensoryMemory) -> Iterator[Any]:
    """At what times nothing is known: before the first step that is remembered, and where nothing was seen."""
    since = memory.since
    if since is None:
        yield UNKNOWN
    elif isinstance(t, Variable):
        yield sometime(-math.inf, since)
        yield from (step.t for step in memory.steps if kind not in step.seen)
    elif not any(step.t == t and kind in step.seen for step in memory.steps):
        yield t


# --- episodes -----------------------------------------------------------------------------------------------------


def _episodes(atom: Compound, memories: Given) -> Relation:
    said, begins, ends = atom.args
    rows: list[Row] = []
    doubtful: list[Row] = []
    names = _names(said)
    if not names:
        doubtful.append((closed(said), UNKNOWN, UNKNOWN))
    for name in names:
        agent, *rest = said.args if isinstance(said, Compound) else (Variable("A"), Variable("O"), Variable("Value"))
        found = _watched(agent, memories)
        if found is None:
            doubtful.append((_shown(said, ()), UNKNOWN, UNKNOWN))
            continue
        for who, memory in found.items():
            kinds = dict.fromkeys(_kinds(name, tuple(rest), memory))
            lasting = (each for each in memory.episodes() if kind_of(each.said) in kinds)
            rows.extend((Compound(each.said), each.begins, each.ends) for each in lasting)
            for kind in kinds:
                shown = _shown(said, (name, who, *kind[1:], _ALL_UNKNOWN))
                for span in memory.unknown(kind):
                    doubtful.extend((shown, *times) for times in _times(begins, ends, span))
    return _relation(DURING, rows, doubtful)


def _names(said: Term) -> list[str]:
    """Of which relations episodes are asked for; none of what is no relation."""
    if isinstance(said, Variable):
        return list(ARITIES)
    fits = isinstance(said, Compound) and ARITIES.get(said.functor) == len(said.args) + 1
    return [said.functor] if isinstance(said, Compound) and fits else []


def _shown(said: Term, otherwise: tuple[Any, ...]) -> Term:
    """What is asked for, as far as it is known; else what may have been."""
    if is_ground(said) or not otherwise:
        return closed(said)
    return Compound(otherwise)


def _times(begins: Term, ends: Term, span: tuple[float, float]) -> Iterator[tuple[Any, Any]]:
    """From when to when an episode of which nothing is known may have been, within a span and as is asked for."""
    first, last = (_within(t, span) for t in (begins, ends))
    yield from product(first, last)


def _within(t: Term, span: tuple[float, float]) -> list[Any]:
    if isinstance(t, Variable):
        return [sometime(*span)]
    if isinstance(t, (int, float)):
        return [t] if span[0] < t < span[1] else []
    return [t] if isinstance(t, Moment) else []
