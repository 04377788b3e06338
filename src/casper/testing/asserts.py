"""Asserts that fail with what one wants to see: the proof, the missing condition, the marked tree.

Each takes a domain, or the knowledge base or reading that it is about, and returns what it looked at.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from itertools import islice
from typing import TypeAlias

from casper.engine.domain.domain import Domain
from casper.engine.explanation.explanation import Explanation, Interleaved
from casper.engine.reading.reading import Reading
from casper.engine.verification.observation import Observed
from casper.kb.base import KnowledgeBase
from casper.kb.errors import BudgetExceeded, Undefined
from casper.kb.reasons.constraints import History
from casper.kb.reasons.validity import Verdict
from casper.kb.terms.terms import Compound, Term
from casper.kb.text.writer import answer_text

Base: TypeAlias = KnowledgeBase | Domain
_SHOWN = 10


def assert_valid(base: Base, statement: str | Compound, after: History = ()) -> Verdict:
    """The statement is provable and breaks no constraint.

    Args:
        base: a domain or its knowledge base.
        statement: such as ``"eat(human, meal, plate)"``; ``_`` is unknown.
        after: what happened before, as ``(statement, seconds)``.

    Raises:
        AssertionError: it is not, or it is unknown; with the reasons and what would mend it.
        CasperError: it is no statement.
    """
    __tracebackhide__ = True
    kb = _base(base)
    verdict = kb.verify(statement, after)
    if verdict.valid is not True:
        mended = [f"it would be: {repair}" for repair in kb.repair(verdict.statement, after)]
        raise AssertionError("\n".join([str(verdict), *mended]))
    return verdict


def assert_rejected(base: Base, statement: str | Compound, because: str = "", after: History = ()) -> Verdict:
    """The statement is not valid, and ``because`` stands in one of the reasons.

    Raises:
        AssertionError: it is valid (with its proof), unknown, or invalid for other reasons.
        CasperError: it is no statement.
    """
    __tracebackhide__ = True
    kb = _base(base)
    verdict = kb.verify(statement, after)
    if verdict.valid:
        proof = kb.why(verdict.completed)
        raise AssertionError(f"{verdict}\nand should not be; its proof:\n{proof}")
    if verdict.valid is None:
        raise AssertionError(f"{verdict}\nso it is not known to be invalid")
    if not any(because in reason for reason in verdict.reasons):
        raise AssertionError(f"no reason says {because!r}:\n{verdict}")
    return verdict


def assert_explains(
    read: Reading | Domain, actions: Sequence[Observed], goal: str | None = None
) -> Explanation | Interleaved:
    """The actions have an explanation (by the goal, where one is named); the best such.

    Args:
        read: a reading, which stays as it is, or a domain, whose fresh reading is taken.
        actions: what was observed, in order.
        goal: the label of a goal.

    Raises:
        AssertionError: they have none; with the first action that has none, and the reasons.
    """
    __tracebackhide__ = True
    reading = _reading(read)
    for number, action in enumerate(actions, 1):
        reading.observe(action)
        if reading.count == 0 or (goal is not None and not reading.posterior.get(goal)):
            raise AssertionError(_unexplained(reading, number, action, goal))
    found = reading.first if goal is None else reading.best_of(goal)
    if found is None:
        raise AssertionError(f"nothing was observed, so {goal or 'no goal'} explains nothing")
    return found


def assert_recognises(
    read: Reading | Domain, actions: Sequence[Observed], goal: str, by: int | None = None
) -> Reading:
    """A reading commits to the goal, by its policy, when ``by`` actions were seen at the latest (None: all of them).

    Having committed it stays so to the end of the actions.

    Raises:
        AssertionError: it does not, or commits to another one; with the shares and the best explanation.
    """
    __tracebackhide__ = True
    reading, last = _reading(read), len(actions) if by is None else by
    for number, action in enumerate(actions, 1):
        reading.observe(action)
        if number >= last and reading.outcome != goal:
            found = "none" if reading.outcome is None else reading.outcome
            raise AssertionError(f"after {number} of {len(actions)} actions the goal is {found}, not {goal}\n{reading}")
    if len(actions) < last or not actions:
        raise AssertionError(f"{len(actions)} actions are too few to see {goal} recognised")
    return reading


def assert_same_answers(base: Base, query: str, other: Base | str | Iterable[Mapping[str, Term]]) -> None:
    """A query has the same answers as in another base, as another query in the same base, or as listed.

    Raises:
        AssertionError: some answers are on one side only; with these.
    """
    __tracebackhide__ = True
    kb = _base(base)
    ours = _answers(kb.query(query))
    if isinstance(other, str):
        theirs = _answers(kb.query(other))
    elif isinstance(other, (KnowledgeBase, Domain)):
        theirs = _answers(_base(other).query(query))
    else:
        theirs = _answers(other)
    told = [*_listed("only here", ours - theirs), *_listed("only there", theirs - ours)]
    if told:
        raise AssertionError("\n".join([f"{query} has other answers:", *told]))


# --- what is shown --------------------------------------------------------------------------------------------------


def _base(base: Base) -> KnowledgeBase:
    return base.kb if isinstance(base, Domain) else base


def _reading(read: Reading | Domain) -> Reading:
    return read.reading() if isinstance(read, Domain) else read.fork()


def _unexplained(reading: Reading, number: int, action: Observed, goal: str | None) -> str:
    goals = reading.rejected if goal is None else {goal: reading.rejected.get(goal, ())}
    known = goal is None or goal in reading.posterior
    if not known:
        return f"there is no goal {goal}; there are {', '.join(reading.posterior)}"
    lines = [f"{action}, action {number}, has no explanation" + (f" by {goal}" if goal else "")]
    lines += [f"  not {name}: {'; '.join(reasons) or 'no leaf is left for it'}" for name, reasons in goals.items()]
    if goal is not None and reading.count:
        lines += ["the best explanation is", str(reading.first)]
    return "\n".join(lines)


def _answers(answers: Iterable[Mapping[str, Term]]) -> frozenset[str]:
    try:
        return frozenset(answer_text(answer) for answer in answers)
    except (Undefined, BudgetExceeded) as mistake:
        raise AssertionError(f"not all answers are known: {mistake}") from None


def _listed(where: str, answers: frozenset[str]) -> list[str]:
    some = [f"  {where}: {answer}" for answer in islice(sorted(answers), _SHOWN)]
    return [*some, f"  {where}: … and {len(answers) - _SHOWN} more"] if len(answers) > _SHOWN else some
