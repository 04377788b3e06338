"""Running minds that follow the files of their domain.

    >>> mind, dropped = renewed(mind, domain)             # what it saw, believed and was committed to stays

`Live` does that for one mind, or for those of all partners, and tells each mistake once.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from casper.engine.collaboration.commitment import Commitment
from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.domain.domain import Domain
from casper.engine.domain.relations import SHARING_NAMES
from casper.engine.domain.reload import Dropped, current_fingerprint, reloaded, replayed
from casper.engine.live.partners import Partners
from casper.engine.mind import Mind
from casper.engine.movements.leaves import TIMED
from casper.engine.reading.underway import Underway
from casper.engine.verification.history import History
from casper.engine.verification.verification import Verifier
from casper.kb.errors import CasperError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term


def renewed(mind: Mind, domain: Domain, history: History | None = None) -> tuple[Mind, tuple[Dropped, ...]]:
    """A mind for the domain that remembers what another one saw, believed and was committed to.

    Perception goes on where it was, unless its own facts (bands, settings, movements, …) have changed: then it starts
    afresh, but for where things are. A commitment that still stands keeps its time. ``history`` is what was done, where
    somebody else has seen to it that it is valid still; None: the mind's own is judged again.

    Raises:
        CasperError: the domain lacks what perception needs, or a setting is wrong; the old mind is as good as before.
    """
    fresh = mind.like(domain, history=history)
    _keep_perception(mind, fresh)
    refused = _keep_history(mind.verifier, fresh.verifier) if history is None else ()
    fresh.course.rows, fresh.course.predicted = mind.course.rows, mind.course.predicted
    dropped: list[Dropped] = []
    for episode in (*mind.course.helped, mind.course.current):
        again, lost = _renewed_episode(episode, fresh)
        fresh.course.resume(again)
        dropped += lost
    known = {d.observed for d in dropped}
    return fresh, (*dropped, *(d for d in refused if d.observed not in known))


def renewed_partners(partners: Partners, domain: Domain) -> tuple[Partners, tuple[Dropped, ...]]:
    """As `renewed`, for all partners; one whom the domain has no more is forgotten.

    Raises:
        CasperError: as `renewed`.
    """
    first, dropped = renewed(partners.first, domain)
    fresh = Partners(domain, **partners.choices)
    fresh.first, fresh.minds, fresh.strangers = first, {first.partner: first}, partners.strangers
    for name, mind in partners.minds.items():
        if mind is not partners.first and name in domain.partners and name != first.partner:
            again, lost = renewed(mind, domain, first.history)
            fresh.add(again)
            dropped += lost
    return fresh, dropped


def _renewed_episode(episode: Underway, fresh: Mind) -> tuple[Underway, list[Dropped]]:
    """The episode read anew, and what of it fits no more."""
    reading = fresh.reading_after(math.inf if episode.begun is None else episode.begun)
    again = Underway(reading, Supervisor(reading, fresh.course.robot, fresh.course.acting), episode.begun, episode.last)
    made, observations = episode.supervisor.commitment, episode.reading.observations
    before = 0 if made is None else made.observations
    dropped = replayed(observations[:before], reading)
    _keep_commitment(made, again.supervisor)
    dropped += replayed(observations[before:], reading)
    _keep_commitment(made, again.supervisor)
    again.supervisor.done = list(episode.supervisor.done)
    return again, dropped


def _keep_commitment(made: Commitment | None, supervisor: Supervisor) -> None:
    """Believe in the same goal since the same time; another goal is for the next observation to tell."""
    if made is not None and supervisor.reading.outcome == made.goal:
        for _ in supervisor.update(made.t):
            pass


def _keep_perception(mind: Mind, fresh: Mind) -> None:
    fresh.memories.of = mind.memories.of
    if mind.partner != fresh.partner:
        return
    settings = fresh.tracker.settings
    fresh.tracker = mind.tracker
    fresh.tracker.settings = settings
    if all(_rows(mind.domain, *i) == _rows(fresh.domain, *i) for i in SHARING_NAMES):
        fresh.perception, fresh.focus = mind.perception, mind.focus
        fresh.movements, fresh.actions = mind.movements, mind.actions


def _rows(domain: Domain, name: str, arity: int) -> Sequence[object]:
    if domain.kb.looks_back_at(name, arity) or (name, arity) == TIMED:
        return [str(clause) for clause in domain.kb.clauses_of((name, arity))]
    return list(domain.kb.rows(name, arity))


def _keep_history(before: Verifier | None, now: Verifier | None) -> tuple[Dropped, ...]:
    """What was accepted is judged again; what is not valid any more did not happen, as far as did/2 is concerned."""
    if before is None or now is None:
        return ()
    dropped = []
    for statement, seconds in before.history:
        verdict = now.kb.verify(statement, now.history)
        if verdict.valid is False:
            observed = as_term(Compound((statement.functor, *statement.args[1:])))
            dropped.append(Dropped(term_text(observed), verdict.reasons))
        else:
            now.history.remember(statement, seconds)
    return tuple(dropped)


@dataclass
class Live:
    """Minds that follow the files of their domain: ask `refresh` as often as you like, between any two steps."""

    mind: Mind | Partners
    _told: str = ""  # the state of the files whose mistake was told last

    def refresh(self) -> tuple[str, ...]:
        """Take in changed files; what there is to say about it, one sentence each, nothing when nothing changed.

        A mistake leaves the old domain in force and is told once, with its place.
        """
        domain = self.mind.domain
        now = current_fingerprint(domain)
        if not domain.fingerprint or now in (domain.fingerprint, self._told):
            return ()
        try:
            dropped = self._renew(reloaded(domain))
        except CasperError as mistake:
            self._told = now
            return (f"the changed domain is not taken: {mistake}",)
        self._told = ""
        return ("the domain was read anew", *map(str, dropped))

    def _renew(self, domain: Domain) -> tuple[Dropped, ...]:
        if isinstance(self.mind, Partners):
            self.mind, dropped = renewed_partners(self.mind, domain)
        else:
            self.mind, dropped = renewed(self.mind, domain)
        return dropped
