"""The mind: world states in, events out. One step of data, from left to right (docs/architecture.md):

    world state -> QSRs -> target, destination -> movement -> action -> verdict -> explanations -> goal -> plan

It never ends: what a partner does is read episode after episode (`engine.reading.course`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from functools import partial
from typing import Any

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.contexts import Contexts, skills_of
from casper.engine.actions.expecting import weights
from casper.engine.actions.prediction import Prediction
from casper.engine.collaboration.acting import acting_settings
from casper.engine.collaboration.printing import supervisor_lines
from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.domain.domain import Domain
from casper.engine.domain.partners.agents import check_agents
from casper.engine.events import Event
from casper.engine.events.entries import Names
from casper.engine.movements.leaves import TIMED
from casper.engine.movements.movements import movement_classifier
from casper.engine.perception.about import About, Handled, about
from casper.engine.perception.filters.association import associator_of
from casper.engine.perception.focus import Focus, FocusEstimator, focus_settings
from casper.engine.perception.perception import Perception, Relations, perception_settings
from casper.engine.perception.remembering.asked import Memories
from casper.engine.perception.remembering.memory import memory_settings
from casper.engine.perception.told import focus_event, jumps
from casper.engine.perception.tracking import Tracker, tracker_settings
from casper.engine.perception.world import Doubt, WorldState
from casper.engine.reading.course import Course
from casper.engine.reading.observing.doubting import Doubting, keeps_goal
from casper.engine.reading.observing.judging import Judging
from casper.engine.reading.observing.stages import movement_event
from casper.engine.reading.observing.stating import Stating
from casper.engine.reading.reading import Reading
from casper.engine.reading.segments import Segments
from casper.engine.verification.doubtful import Judged
from casper.engine.verification.forgetting import Forgetting
from casper.engine.verification.history import History, history_settings
from casper.engine.verification.observation import Seen
from casper.engine.verification.unwatched import CARRYING, Unwatched
from casper.engine.verification.verification import Verifier
from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound
from casper.kb.text.lines import Line, Span, line, one_line, text_of


class Mind:
    """Watches one partner of a domain.

    Args:
        domain: where it happens.
        verification: False never asks the knowledge base about an observation; the explainer sees names only.
        policy: when to commit to a goal (`engine.reading.policy`).
        helps: False predicts without planning to help.
        noise, goals: as for `Domain.reading`: needless actions at a price, several goals at once. Without a price there
            are none, until the sensor is found to be poor: then they have the domain's (`Readings.prices`).
        stops: an action that fits no plan any more ends it; by default it is reported and left out, or, of a poor
            sensor, weighed as needless.
        partner: who is watched; None: the domain's `partner`.
        history: what was done so far today, which all minds of one world share; None: nothing.
        certainty: how sure a goal must be before the robot acts on it (`engine.collaboration.acting`); None: as the
            domain says.
        memories: what was seen lately, shared likewise; kept where the domain's rules ask for it.
        segments: makes what says which episode an action belongs to (`engine.reading.course`); None: `BySight`.

    Raises:
        DomainError: the domain lacks what perception needs (movements, transitions, …), a setting is wrong, or names
            somebody who is not in the world.
        CasperError: a price or a number of goals that is none.
    """

    def __init__(
        self,
        domain: Domain,
        *,
        verification: bool = True,
        policy: str = "strict",
        helps: bool = True,
        noise: float | None = None,
        goals: int = 1,
        stops: bool = False,
        partner: str | None = None,
        history: History | None = None,
        memories: Memories | None = None,
        segments: Callable[[str, Callable[[], Reading]], Segments] | None = None,
        certainty: float | None = None,
    ) -> None:
        check_agents(domain.kb)
        rows = domain.kb.rows
        self.domain, self.partner = domain, partner or domain.partner
        choices: dict[str, Any] = {"verification": verification, "policy": policy, "noise": noise, "goals": goals}
        rest: dict[str, Any] = {"helps": helps, "stops": stops, "partner": partner, "segments": segments}
        rest["certainty"] = certainty
        self.like: Callable[..., Mind] = partial(Mind, **choices, **rest)
        own, tracking = None if self.partner == domain.robot else domain.robot, tracker_settings(rows)
        self.tracker = Tracker(tracking, own, associator_of(tracking, domain.kb))
        self.perception = Perception(perception_settings(rows), self.partner)
        self.focus = FocusEstimator(focus_settings(rows))
        self.handled = Handled()
        self.movements = movement_classifier(rows, domain.kb.clauses_of(TIMED))
        self._known_actions, self._skills = {name for name, _ in domain.library.actions}, skills_of(domain.kb)
        self.actions = action_recogniser(rows, None, self._skills, self._known_actions)
        self.history = history if history is not None else History(history_settings(rows).remembered)
        self.memories = memories if memories is not None else Memories(memory_settings(rows))
        self._remembers = bool(domain.kb.asks_outside)
        seen = (lambda: self.known) if self._remembers else None
        self.verifier = Verifier(domain.kb, self.history, seen) if verification and domain.verifies else None
        self._fresh = partial(domain.reading, **choices, partner=self.partner)
        self._in_doubt = domain.prices.needless if noise is None and not stops else noise  # price where eyes are poor
        acting, robot = acting_settings(rows, certainty), domain.robot if helps else None
        asked = Contexts(domain.kb), self.history, lambda: self.known
        self._stating = Stating(self.partner, *asked, self.verifier, self._begun, self._known_actions)
        self._judging = Judging(self._stating, [n for n in self._known_actions if self._skills.get(n, n) == CARRYING])
        self.course = Course(self.partner, robot, self._begun, segments, stops=stops, acting=acting)
        self.doubting: Doubting | None = None  # where the tracker is not sure of what it tells
        self._unwatched = Unwatched(self.partner)
        self._forgetting = Forgetting(self.history, domain.kb)

    @property
    def known(self) -> KnowledgeBase:
        """The domain's knowledge base with what was seen by now (`engine.perception.remembering.asked`), as a view."""
        return self.memories.known(self.domain.kb) if self._remembers else self.domain.kb

    def _begun(self) -> Reading:
        """A reading in which nothing was observed, after what was done earlier."""
        return self._fresh(earlier=self._judging.earlier)

    def reading_after(self, t: float) -> Reading:
        """A reading in which nothing was observed, after what was done before that time."""
        return self._fresh(earlier=[done for done in self.history if done[1] < t])

    @property
    def reading(self) -> Reading:
        """Of the episode under way."""
        return self.course.current.reading

    @property
    def supervisor(self) -> Supervisor:
        """Of the episode under way."""
        return self.course.current.supervisor

    def update(self, world: WorldState) -> list[Event]:
        """Take in one world state; what was seen, believed, refused, concluded and planned.

        Raises:
            WorldStateError: time does not advance, or a coordinate is no finite number; the state is not taken in,
                and the mind can go on with the next one.
            CasperError: the mind was told to stop at an action that fits no plan, and there was one.
        """
        steady = self.tracker.steps(world)
        events = jumps(self.tracker, world.t)
        for state in steady:
            events += self.notice(state)
        return events

    def notice(self, world: WorldState) -> list[Event]:
        """As `update`, of a world state that a tracker has been through."""
        relations = self.perception.update(world, tracked=True)
        if self._remembers:
            self.memories.update(self.partner, world.t, relations)
        found = self._unwatched.update(world) if self.doubting is None else ()
        unseen = [event for thing, place in found for event in self._infer(thing, place, world.t)]
        if relations is None:
            return unseen
        focus = self.focus.update(relations)
        movement = self.movements.update(relations, focus)
        events = [*unseen, focus_event(focus, self.partner), movement_event(movement, self.partner)]
        prediction, handled = self.actions.update(movement), self.handled.update(relations)
        if relations.doubt is not None:
            events += [event.about(self.partner) for event in self._doubt(focus, world, relations.doubt)]
        if prediction is not None:
            about = self._about(focus, world, handled)
            events += [event.about(self.partner) for event in self._consider(prediction, about, world)]
        if self._judging.assumed is not None:
            events += self._put_elsewhere(relations, world)
        return events

    def _infer(self, thing: str, place: str, t: float) -> Iterator[Event]:
        """A thing lies where nobody saw it brought: a step of a goal that was taken to be given up, perhaps."""
        for action in self._judging.brought(thing, place, t):
            yield from self.course.inferred(action, t)

    def _put_elsewhere(self, relations: Relations, world: WorldState) -> list[Event]:
        """What was taken to be brought to the one place where it may go, and was put down elsewhere, is taken back."""
        found = self._judging.put_elsewhere(relations, world)
        if found is None:
            return []
        action, made = found
        self.history.forget(Compound((action.action, self.partner, *(action.args or ()))))
        told = self.reading.tell.phrase("put elsewhere", made.target, made.place)
        return list(self.course.refuted(action, world.t, told))

    def _about(self, focus: Focus, world: WorldState, handled: str | None) -> About:
        """What an action of this moment is about."""
        if self.focus.settings.steady:
            return about(focus, handled, world)
        return About(focus.target, (focus.destination,))

    def did(self, action: Compound, t: float) -> list[Event]:
        """The robot has done an action of its part (without the agent): it happened, and its episode may be over."""
        self.history.remember(Compound((action.functor, self.domain.robot, *action.args)), t)
        return list(self.course.did(action, t))

    def failed(self, action: Compound, t: float) -> list[Event]:
        """The robot could not do an action of its part, and gives it up; the partner may do it."""
        self.course.failed(action)
        return []

    def end(self, t: float) -> list[Event]:
        """Nobody watches any more: the episodes that are still open are over."""
        return list(self.course.end(t))

    def summary(self, goal: str | None = None, seed: int | None = None) -> dict[str, Any]:
        """The data of a ``summary`` event; ``goal`` is what the partner really wanted, where somebody knows.

        The figures are of the goal that was committed to last, ``episodes`` has a row for each that is over.
        """
        figures = (self.course.committed or self.supervisor).summary()
        correct = None if goal is None else figures["predicted"] == goal
        nobody: dict[str, Any] = {"actions": [], "done": False}
        rest = {"robot": nobody, "verification": self.verifier is not None, "seed": seed}
        return {"goal": goal, "correct": correct, **figures, **rest, "episodes": list(self.course.rows)}

    def lines(self) -> Iterator[Line]:
        """What a person is shown: who watches whom, the reading, the goal believed in, and the robot's part."""
        yield line(Span(self.domain.name, "strong"), f": {self.domain.robot} watches {self.partner}")
        yield from self.reading.lines()
        names = Names(self.partner, self.domain.robot, self.domain.kb.words)
        yield from supervisor_lines(self.supervisor, names)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return one_line(f"Mind that watches {self.partner} in {self.domain.name}: {self.reading!r}")

    def _doubt(self, focus: Focus, world: WorldState, doubt: Doubt) -> Iterator[Event]:
        """The tracker is not sure of what it tells: what actions may be about is noted, and what is used up."""
        if self.doubting is None:
            self.doubting = Doubting(self._stating, self._skills, self.domain.kb.rows("consumes", 1))
            self._fresh = partial(self._fresh, noise=self._in_doubt)
            self.course.doubt(self._in_doubt)
        self.doubting.note(self.actions.scores, focus, self.handled.lately(world.t), world, doubt)
        if self.doubting.is_gone(world):
            found = self.doubting.used_up(world, self.reading.frontiers)
            if found is not None and found.seen is not None and keeps_goal(self.reading, found.seen):
                yield from self._take(self.doubting, found, 1.0, world.t)

    def _take(self, doubting: Doubting, found: Judged | None, score: float, t: float) -> Iterator[Event]:
        """What seems to have happened is passed on to the reading."""
        seen = yield from self._judging.of_doubt(found, score, t, self.actions.misread)
        if seen is not None:
            self.actions.accept()
            doubting.accepted()
            yield from self._read(seen, t)
            self.actions.expect(weights(self.reading.next_actions, self._skills, self.actions.scores))

    def _consider(self, prediction: Prediction, about: About, world: WorldState) -> Iterator[Event]:
        """An action seems to have happened: put it into context, verify it, and pass it on to the reading."""
        if self.doubting is not None:
            yield from self._take(self.doubting, self.doubting.judged(prediction), prediction.score, prediction.t)
            return
        seen = yield from self._judging.of(prediction, about, world, self.actions.misread)
        if seen is not None:
            self.actions.accept()
            yield from self._read(seen, prediction.t)

    def _read(self, observation: Seen, t: float) -> Iterator[Event]:
        if observation.action not in self._known_actions:
            yield Event("warning", t, {"message": f"{observation} is in no plan; it explains nothing"})
            return
        yield from self._forgetting.told(t)
        yield from self.course.read(observation, t)
