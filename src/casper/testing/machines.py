"""Stateful tests: what comes and goes in any order, against the oracle that starts afresh each time."""

from __future__ import annotations

from collections.abc import Callable

from hypothesis import HealthCheck, settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)

from casper.engine.domain.domain import Domain
from casper.engine.reading.reading import Reading
from casper.kb.base import KnowledgeBase
from casper.testing.strategies.pursuits import observations
from casper.testing.strategies.statements import facts
from casper.testing.values import text_of, well_typed

MOST_ASKED = 40  # statements that are compared after each change
MOST_STEPS = 12


def run_machine(machine: Callable[[], RuleBasedStateMachine], steps: int = MOST_STEPS) -> None:
    """Run a machine with as many examples as the profile says, a quarter of them at most 50."""
    examples = max(1, min(settings.default.max_examples // 4, 50)) if settings.default else 25
    slow = [HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.large_base_example]
    bounded = settings(
        max_examples=examples,
        stateful_step_count=steps,
        deadline=None,
        suppress_health_check=slow,
        print_blob=False,
    )
    run_state_machine_as_test(machine, settings=bounded)  # type: ignore[arg-type]  # whatever makes one does


class BaseMachine(RuleBasedStateMachine):
    """Asserts and retracts facts of a base; it must always say what a base says that is made of its facts at once."""

    def __init__(self, kb: KnowledgeBase) -> None:
        super().__init__()
        self.kb = kb.assume()
        self.log: list[str] = []
        self.asked = [s for indicator in kb.declared for s in well_typed(kb, indicator, MOST_ASKED)][:MOST_ASKED]
        self.facts = facts(kb)

    @rule(data=st.data())
    def assert_a_fact(self, data: st.DataObject) -> None:
        """A fact comes, or was there."""
        fact = data.draw(self.facts, "assert")
        self.kb.assert_(fact)
        self.log.append(f"assert {fact}")

    @rule(data=st.data())
    def retract_a_fact(self, data: st.DataObject) -> None:
        """A fact goes, or was not there."""
        fact = data.draw(self.facts, "retract")
        self.kb.retract(fact)
        self.log.append(f"retract {fact}")

    @precondition(lambda self: self.log)
    @invariant()
    def says_what_a_fresh_one_says(self) -> None:
        """Every statement has the same verdict as in a base made of the text of this one."""
        fresh = KnowledgeBase.from_text(self.kb.to_text())
        fresh.declare_statements(self.kb.declared)
        for statement in self.asked:
            ours, theirs = self.kb.verify(statement).valid, fresh.verify(statement).valid
            assert ours == theirs, f"after {', '.join(self.log)} {text_of(statement)} is {ours}, afresh {theirs}"


class ReadingMachine(RuleBasedStateMachine):
    """Observes, takes back and copies; each reading must always say what one says that observes what is left."""

    def __init__(self, domain: Domain) -> None:
        super().__init__()
        self.domain = domain
        self.pursuits = observations(domain, drop=0.5, needless=0.5)

    @initialize()
    def begin(self) -> None:
        """Two readings of nothing."""
        self.readings: list[tuple[Reading, list[str]]] = [(self.domain.reading(), []), (self.domain.reading(), [])]

    @rule(data=st.data(), at=st.integers(0, 1))
    def observe(self, data: st.DataObject, at: int) -> None:
        """One of them observes an action of somebody's pursuit."""
        action = data.draw(self.pursuits.map(lambda pursuit: pursuit.actions[-1]), "observe")
        reading, seen = self.readings[at]
        reading.observe(action)
        seen.append(action)

    @rule(at=st.integers(0, 1))
    def take_back(self, at: int) -> None:
        """One of them takes its last observation back, if it has one."""
        reading, seen = self.readings[at]
        if seen:
            reading.undo()
            seen.pop()

    @rule(at=st.integers(0, 1))
    def copy(self, at: int) -> None:
        """One of them becomes a copy of the other."""
        reading, seen = self.readings[at]
        self.readings[1 - at] = reading.fork(), list(seen)

    @invariant()
    def says_what_a_fresh_one_says(self) -> None:
        """The shares and the number of explanations are those of a fresh reading."""
        for reading, seen in getattr(self, "readings", ()):
            fresh = self.domain.reading()
            for action in seen:
                fresh.observe(action)
            same = dict(reading.posterior) == dict(fresh.posterior) and reading.count == fresh.count
            assert same, f"{', '.join(seen)} is read as {dict(reading.posterior)}, afresh {dict(fresh.posterior)}"
