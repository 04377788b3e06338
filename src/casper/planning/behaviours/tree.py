"""The tree: waits for the partner's steps, then the robot's own, each behind a guard.

    >>> tree = behaviour_tree(reading.plan_for("tiago"), {"wash": wash, …}, kitchen, reading)   # doctest: +SKIP
    >>> tree.tick_once(); print(py_trees.display.unicode_tree(tree, show_status=True))           # doctest: +SKIP
    {-} tiago's part in lunch [*]
        --> wait for cook(meal, hobs) [*] -- not seen yet
        …
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, TypeAlias

from casper.engine.collaboration.collaboration import CollaborativePlan
from casper.engine.domain.domain import Domain
from casper.engine.reading.reading import Reading
from casper.kb.errors import CasperError
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.planning.behaviours.memory import Memory

try:
    from py_trees.behaviour import Behaviour
    from py_trees.common import Status
    from py_trees.composites import Sequence
    from py_trees.decorators import Decorator
except ImportError:
    raise CasperError("behaviour trees need py_trees: pip install 'casper-hri[behaviour-trees]'") from None

Filler: TypeAlias = "Callable[..., Any] | Behaviour"
"""What does an action: see `behaviour_tree`."""


def behaviour_tree(
    plan: CollaborativePlan, actions: Mapping[str, Filler], domain: Domain, reading: Reading
) -> Sequence:
    """A collaborative plan as a tree of py_trees.

    The tree waits until the partner's steps were observed by the reading, and then does the robot's one after another.
    Before and while an action is done its guard asks the knowledge base whether it is valid after all that happened; a
    guard that fails, or cannot say, fails the tree, with the reason as its feedback. An action that succeeds is told to
    the reading, as an observation.

    Args:
        plan: the robot's part.
        actions: by name of action what does it. A function is called at each tick with the action's arguments and
            returns a status of py_trees, or True (done), False (failed) or None (going on). A class of behaviours is
            made with the action's text as its name. A behaviour stands in the tree as it is, once.
        domain: its knowledge base guards.
        reading: what is seen; it is told what is done.

    Raises:
        CasperError: an action has nothing that does it, one behaviour stands for two actions, or py_trees is missing.
    """
    missing = sorted({action.functor for action in plan.actions} - set(actions))
    if missing:
        raise CasperError(f"nothing does {', '.join(missing)}: give a function or a behaviour for each action's name")
    memory = Memory(plan, domain, reading)
    root = Sequence(f"{plan.agent}'s part in {plan.goal}", memory=True)
    for leaf, action in zip(plan.awaited, plan.waiting):
        root.add_child(Wait(leaf, action, memory))
    used: set[int] = set()
    for action in plan.actions:
        step = Sequence(f"do {_text(action)}", memory=False)
        step.add_children([Guard(action, memory), Told(_leaf(action, actions[action.functor], used), action, memory)])
        root.add_child(step)
    return root


class Wait(Behaviour):
    """Running until a step of the partner was observed."""

    def __init__(self, leaf: int, action: Compound, memory: Memory) -> None:
        super().__init__(f"wait for {_text(action)}")
        self.leaf, self.action, self.memory = leaf, action, memory

    def update(self) -> Status:
        """Looks at the reading."""
        done = self.memory.is_done(self.leaf, self.action)
        self.feedback_message = "seen" if done else "not seen yet"
        return Status.SUCCESS if done else Status.RUNNING


class Guard(Behaviour):
    """Succeeds while the knowledge base lets the robot do an action."""

    def __init__(self, action: Compound, memory: Memory) -> None:
        super().__init__(f"may {memory.plan.agent} {_text(action)}?")
        self.action, self.memory = action, memory

    def update(self) -> Status:
        """Asks the knowledge base."""
        verdict = self.memory.verdict(self.action)
        reasons = "; ".join(verdict.reasons)
        self.feedback_message = "valid" if verdict.valid else reasons or "not known"
        return Status.SUCCESS if verdict.valid else Status.FAILURE


class Call(Behaviour):
    """An action that a function does."""

    def __init__(self, action: Compound, function: Callable[..., Any]) -> None:
        super().__init__(_text(action))
        self.action, self.function = action, function

    def update(self) -> Status:
        """Calls it; a mistake in it is a failure with the mistake as feedback."""
        try:
            said = self.function(*self.action.args)
        except Exception as mistake:  # the user's code may raise anything, and the tree goes on
            self.feedback_message = f"{type(mistake).__name__}: {mistake}"
            return Status.FAILURE
        if isinstance(said, Status):
            return said
        if said is None:
            return Status.RUNNING
        return Status.SUCCESS if said is True else Status.FAILURE


class Told(Decorator):
    """Tells the reading once its action has succeeded; not again while the tree stays where it is."""

    def __init__(self, child: Behaviour, action: Compound, memory: Memory) -> None:
        super().__init__(name=f"tell {_text(action)}", child=child)
        self.action, self.memory = action, memory

    def update(self) -> Status:
        """As its action."""
        if self.decorated.status == Status.SUCCESS:
            self.feedback_message = self.memory.tell(self.action)
        return self.decorated.status


def _leaf(action: Compound, filler: Filler, used: set[int]) -> Behaviour:
    if isinstance(filler, Behaviour):
        if id(filler) in used:
            raise CasperError(f"one behaviour cannot do two actions ({_text(action)} is the second): give its class")
        used.add(id(filler))
        return filler
    if isinstance(filler, type) and issubclass(filler, Behaviour):
        return filler(_text(action))
    if not callable(filler):
        raise CasperError(f"{filler!r} cannot do {_text(action)}: give a function or a behaviour")
    return Call(action, filler)


def _text(action: Compound) -> str:
    return term_text(as_term(action))
