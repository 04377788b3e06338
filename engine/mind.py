"""The mind: world states in, events out. One step of data, from left to right (docs/architecture.md):

    world state -> QSRs -> target, destination -> movement -> action -> verdict -> explanations -> goal -> plan

It never ends: what a partner does is read episode after episode (`engine.reading.course`).
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import asdict, replace
from functools import partial
from typing import Any

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.contexts import Contexts, skills_of
from casper.engine.actions.expecting import weights
from casper.engine.actions.prediction import Prediction
from casper.engine.collaboration.acting import acting_settings
from casper.engine.collaboration.supervisor import Supervisor
from casper.engine.domain.agents import check_agents
from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.engine.events.printing import Names, plan_lines, prediction_lines
from casper.engine.movements.leaves import TIMED
from casper.engine.movements.movements import movement_classifier
from casper.engine.perception.about import About, Handled, about
from casper.engine.perception.focus import Focus, FocusEstimator, focus_settings
from casper.engine.perception.perception import Perception, Relations, perception_settings
from casper.engine.perception.remembering.asked import Memories
from casper.engine.perception.remembering.memory import memory_settings
from casper.engine.perception.told import focus_event, jumps
from casper.engine.perception.tracking import Tracker, tracker_settings
from casper.engine.perception.world import Doubt, WorldState
from casper.engine.reading.course import Course
from casper.engine.reading.doubting import Doubting, keeps_goal
from casper.engine.reading.reading import Reading
from casper.engine.reading.segments import Segments
from casper.engine.reading.stages import movement_event, verdict_event
from casper.engine.reading.stating import Stating
from casper.engine.verification.assumed import Assumed, assumed
from casper.engine.verification.doubtful import Judged
from casper.engine.verification.history import Done, History, history_settings
from casper.engine.verification.observation import Observation, Seen
from casper.engine.verification.unwatched import CARRYING, Unwatched
from casper.engine.verification.verification import Statement, Verifier
from casper.kb.base import KnowledgeBase
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
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
        self.tracker = Tracker(tracker_settings(rows), None if self.partner == domain.robot else domain.robot)
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
        self._earlier: Sequence[Done] = ()  # what was done before the last action, as far as rules look back
        self._fresh = partial(domain.reading, **choices, partner=self.partner)
        self._in_doubt = domain.prices.needless if noise is None and not stops else noise  # price where eyes are poor
        acting, robot = acting_settings(rows, certainty), domain.robot if helps else None
        self.course = Course(self.partner, robot, self._begun, segments, stops=stops, acting=acting)
        asked = Contexts(domain.kb), self.history, lambda: self.known
        self._stating = Stating(self.partner, *asked, self.verifier, self._begun, self._known_actions)
        self.doubting: Doubting | None = None  # where the tracker is not sure of what it tells
        self._refused: str | None = None  # the statement that was refused last: its verdict is told once
        self._accepted: Observation | None = None  # the last action
        self._assumed: Assumed | None = None  # where it is done, where that was not seen yet
        self._unwatched = Unwatched(self.partner)
        self._lost: Compound | None = None  # what was told last of what is forgotten

    @property
    def known(self) -> KnowledgeBase:
        """The domain's knowledge base with what was seen by now (`engine.perception.remembering.asked`), as a view."""
        return self.memories.known(self.domain.kb) if self._remembers else self.domain.kb

    def _begun(self) -> Reading:
        """A reading in which nothing was observed, after what was done earlier."""
        return self._fresh(earlier=self._earlier)

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
        if self._assumed is not None:
            events += self._put_elsewhere(relations, world)
        return events

    def _infer(self, thing: str, place: str, t: float) -> Iterator[Event]:
        """A thing lies where nobody saw it brought: a step of a goal that was taken to be given up, perhaps."""
        for action in (name for name in self._known_actions if self._skills.get(name, name) == CARRYING):
            statement = Statement(t, self.partner, action, thing, place)
            if self.verifier is None or self.verifier.judge(statement).valid:
                yield from self.course.inferred(Observation(action, (thing, place), t), t)

    def _put_elsewhere(self, relations: Relations, world: WorldState) -> list[Event]:
        """What was taken to be brought to the one place where it may go, and was put down elsewhere, is taken back."""
        made, action = self._assumed, self._accepted
        was_put = None if made is None else made.update(relations, world)
        if made is None or action is None or was_put is None:
            return []
        self._assumed = None
        if was_put:
            return []
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
        made = self.supervisor.commitment
        if made is not None:
            names = Names(self.partner, self.domain.robot, self.domain.kb.words)
            yield from prediction_lines(made.t, {"goal": made.goal, **self.supervisor.summary()}, names)
        if made is not None and self.supervisor.robot is not None:
            waiting, actions = (
                [term_text(as_term(action)) for action in part]
                for part in (self.supervisor.waiting, self.supervisor.actions)
            )
            yield from plan_lines(self.supervisor.robot, waiting, actions, self.reading.tell)

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
        if found is None or str(found.statement) == self._refused:
            return
        yield self._action_event(str(found.statement), score, t)
        if found.verdict is not None:
            yield verdict_event(t, found.verdict)
        if found.seen is None:
            self._refused = str(found.statement)
            return
        if self.verifier is not None and found.verdict is not None:
            self._earlier = tuple(self.verifier.looked_at)
            self.verifier.accept(found.verdict, t)
        seen = replace(found.seen, certainty=min(score, 1.0)) if isinstance(found.seen, Observation) else found.seen
        self._refused = None
        self.actions.accept()
        doubting.accepted()
        yield from self._read(seen, t)
        self.actions.expect(weights(self.reading.next_actions, self._skills, self.actions.scores))

    def _consider(self, prediction: Prediction, about: About, world: WorldState) -> Iterator[Event]:
        """An action seems to have happened: put it into context, verify it, and pass it on to the reading."""
        if self.doubting is not None:
            yield from self._take(self.doubting, self.doubting.judged(prediction), prediction.score, prediction.t)
            return
        before = self._stating.doubt
        statement = self._stating.of(prediction, about, world)
        if statement is None:
            if self._stating.doubt not in ("", before):
                yield Event("warning", prediction.t, {"message": self._stating.doubt})
            return  # not yet known what it means; the prediction stands, and the next step may tell
        if str(statement) == self._refused:
            return
        yield self._action_event(str(statement), prediction.score, prediction.t)
        observation: Observation | None
        if self.verifier is not None:
            verdict = self.verifier.judge(statement)
            yield verdict_event(prediction.t, verdict)
            if not verdict.valid:
                self._refused = str(statement)
                return
            self._earlier = tuple(self.verifier.looked_at)
            observation = self.verifier.accept(verdict, prediction.t)
        else:
            observation = Observation(statement.action, t=prediction.t)
        observation = replace(observation, certainty=min(prediction.score, 1.0))
        self._refused, self._accepted = None, observation
        self._assumed = assumed(statement.destination, observation.args or ())
        self.actions.accept()
        yield from self._read(observation, prediction.t)

    def _action_event(self, statement: str, score: float, t: float) -> Event:
        misread = [asdict(each) for each in self.actions.misread()]
        return Event("action", t, {"statement": statement, "score": score, "misread": misread})

    def _read(self, observation: Seen, t: float) -> Iterator[Event]:
        if observation.action not in self._known_actions:
            yield Event("warning", t, {"message": f"{observation} is in no plan; it explains nothing"})
            return
        yield from self._forgotten(t)
        yield from self.course.read(observation, t)

    def _forgotten(self, t: float) -> Iterator[Event]:
        """What rules on did/2 no longer see is said."""
        lost = self.history.lost
        if lost is not None and lost != self._lost and self.domain.kb.depends_on_history:
            self._lost = lost
            room = f"setting(verification, remembered, {self.history.most}) leaves no room for it"
            yield Event("warning", t, {"message": f"did/2 no longer has {term_text(as_term(lost))}: {room}"})
