"""Test classes that one subclasses with one's own domain, recogniser or planner, and gets the laws for nothing.

    class TestMyHome(DomainContract):
        domain = Domain.load("home")

        def expected(self, statement):              # what one knows independently; None: no opinion
            return statement.functor != "eat" or statement[1] in PEOPLE

    class TestMyRecogniser(RecogniserContract):
        domain = Domain.load("home")

        def recogniser(self):
            return MyRecogniser(self.domain.library)

Each law is a test of its own; one that says nothing of the domain is skipped, with its reason.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, Protocol

import pytest
from hypothesis import given

from casper.engine.domain.domain import Domain
from casper.engine.domain.examples import examples_of, failure
from casper.engine.reading.reading import Reading
from casper.engine.verification.history import in_order
from casper.kb.terms.terms import Compound
from casper.kb.text.reader import read_statement
from casper.testing.asserts import assert_rejected, assert_valid
from casper.testing.laws import LAWS, Law, NotApplicable
from casper.testing.machines import BaseMachine, ReadingMachine, run_machine
from casper.testing.profiles import checked
from casper.testing.strategies.pursuits import Pursuit, observations
from casper.testing.strategies.statements import statements


class Recogniser(Protocol):
    """What is held to the laws of recognisers: any object that takes actions in and has a posterior."""

    def observe(self, action: str, /) -> Any:
        """Take in an action."""

    @property
    def posterior(self) -> Mapping[str, float]:
        """Each goal's probability."""


class DomainContract:
    """Holds a domain to the laws (`casper.testing.laws`), to its own examples, and to what one expects of it."""

    domain: Domain
    skipped_laws: Sequence[str] = ()
    """Names of laws that the domain breaks on purpose."""

    def expected(self, statement: Compound) -> bool | None:
        """Whether a statement should be valid; None where one has no opinion. Override it with one's own knowledge."""
        return None

    @pytest.mark.parametrize("law", LAWS, ids=lambda law: law.name)
    def test_law(self, law: Law) -> None:
        """What must hold of every domain."""
        if law.name in self.skipped_laws:
            pytest.skip(f"{law.name} is broken on purpose")
        try:
            law.check(self.domain)
        except NotApplicable as reason:
            pytest.skip(str(reason))

    def test_examples(self) -> None:
        """The examples of the domain's ``tests.pl`` hold."""
        tried = [(example.place, failure(self.domain, example)) for example in examples_of(self.domain.folder)]
        wrong = [f"{place}: {why}" for place, why in tried if why is not None]
        assert not wrong, "\n".join(wrong)

    def test_expected(self) -> None:
        """What one expects of statements is so."""
        if type(self).expected is DomainContract.expected:
            pytest.skip("nothing is expected; override expected(statement) to say what should be valid")
        kb = self.domain.kb

        @checked
        @given(statements(kb))
        def law(statement: str) -> None:
            wanted = self.expected(read_statement(statement))
            if wanted is True:
                assert_valid(kb, statement)
            elif wanted is False:
                assert_rejected(kb, statement)

        law()

    def test_facts_that_come_and_go(self) -> None:
        """Facts asserted and retracted in any order leave what the facts alone make."""
        if not self.domain.verifies:
            pytest.skip("the domain has no ontology.pl")
        run_machine(lambda: BaseMachine(self.domain.kb))

    def test_observations_that_come_and_go(self) -> None:
        """Observing, taking back and copying in any order is reading what is left from the start."""
        if not self.domain.library.ways:
            pytest.skip("the domain has no plans")
        run_machine(lambda: ReadingMachine(self.domain))


class RecogniserContract:
    """Holds a recogniser of goals to the laws of recognition, on the pursuits of a domain's plans."""

    domain: Domain
    by: float = 1.0
    """Which part of a goal's steps, all seen, must be enough for it to lead."""

    def recogniser(self) -> Recogniser:
        """A fresh recogniser. Override it."""
        raise NotImplementedError("override recogniser() to return a fresh one of yours")

    def test_shares_sum_to_one(self) -> None:
        """Probabilities are none below zero, and sum to one or, where nothing explains the actions, to zero."""

        @checked
        @given(observations(self.domain, drop=0.5, needless=0.3))
        def law(pursuit: Pursuit) -> None:
            mine = self.recogniser()
            for number, action in enumerate(pursuit.actions, 1):
                mine.observe(action)
                shares = mine.posterior
                seen = ", ".join(pursuit.actions[:number])
                whole = sum(shares.values())
                assert min(shares.values()) >= 0, f"a probability below zero after {seen}: {dict(shares)}"
                assert abs(whole) < 1e-6 or abs(whole - 1) < 1e-6, f"the probabilities sum to {whole} after {seen}"

        law()

    def test_goals_are_those_of_the_library(self) -> None:
        """It names the goals that there are, and no others."""

        @checked
        @given(observations(self.domain))
        def law(pursuit: Pursuit) -> None:
            mine = self.recogniser()
            for action in pursuit.actions:
                mine.observe(action)
            unknown = set(mine.posterior) - set(self.domain.library.goals)
            assert not unknown, f"there are no goals {', '.join(sorted(unknown))}"

        law()

    def test_the_same_actions_give_the_same_answer(self) -> None:
        """Two fresh recognisers that see the same say the same."""

        @checked
        @given(observations(self.domain, drop=0.5))
        def law(pursuit: Pursuit) -> None:
            one, other = self.recogniser(), self.recogniser()
            for action in pursuit.actions:
                one.observe(action)
                other.observe(action)
            assert dict(one.posterior) == dict(other.posterior), f"{', '.join(pursuit.actions)} gives two answers"

        law()

    def test_a_goal_leads_when_it_was_pursued(self) -> None:
        """When so many of its steps were seen, in order, the goal is as likely as any."""

        @checked
        @given(observations(self.domain))
        def law(pursuit: Pursuit) -> None:
            mine = self.recogniser()
            enough = max(1, round(self.by * len(pursuit.actions)))
            for action in pursuit.actions[:enough]:
                mine.observe(action)
            share, most = mine.posterior.get(pursuit.goal, 0.0), max(mine.posterior.values())
            seen = ", ".join(pursuit.actions[:enough])
            assert share >= most - 1e-6, f"after {seen} of {pursuit.goal} its share is {share}, another's is {most}"

        law()


class PlannerContract:
    """Holds a planner of the robot's part to the domain: each step valid, none that was done, in the plan's order."""

    domain: Domain

    def plan(self, reading: Reading) -> Sequence[str | Compound]:
        """What the robot is to do after what was read. Override it."""
        raise NotImplementedError("override plan(reading) to return your planner's steps")

    def test_every_step_is_valid_for_the_robot(self) -> None:
        """Each step is valid for the robot after what others do in the plan, and its own earlier steps."""

        @checked
        @given(observations(self.domain, drop=0.3))
        def law(pursuit: Pursuit) -> None:
            reading = self.domain.reading()
            for action in pursuit.actions:
                reading.observe(action)
            best = reading.first
            if best is None:
                return
            partner, robot = self.domain.partner, self.domain.robot
            steps = [read_statement(step) if isinstance(step, str) else step for step in self.plan(reading)]
            ours = [repr(step) for step in steps]
            others = [leaf for part in best.parts for leaf in part.leaves if repr(leaf) not in ours]
            history = in_order(Compound((leaf.functor, partner, *leaf.args)) for leaf in others)
            for step in steps:
                statement = Compound((step.functor, robot, *step.args))
                verdict = self.domain.kb.verify(statement, history)
                seen = ", ".join(pursuit.actions)
                assert verdict.valid, f"after {seen}, {statement} is not valid: {'; '.join(verdict.reasons)}"
                history = in_order([statement], history)

        law()
