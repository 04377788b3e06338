"""What an action means where it happens (paper, table context): a table, or rules that ask what was seen and done."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING

from casper.engine.settings import Rows, require
from casper.kb.errors import Undefined
from casper.kb.reasons.constraints import History
from casper.kb.terms.clauses import Indicator, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.terms.unification import substitute
from casper.kb.terms.unknown import DOUBT

if TYPE_CHECKING:
    from casper.kb.base import KnowledgeBase

CONTEXT: Indicator = ("context", 3)
_MEANING = Variable("Meaning")


class Contexts:
    """The domain's ``context(Action, Destination, Meaning)``.

    Where no rule of it asks for the moment (what was seen, what was done) it is worked out once.

    Raises:
        DomainError: at construction, one action and destination with two meanings.
    """

    def __init__(self, kb: KnowledgeBase) -> None:
        clauses = kb.clauses_of(CONTEXT)
        self._moves = bool(clauses) and kb.looks_back_at(*CONTEXT)
        self._table = {} if self._moves else context_table(kb.rows)
        self._heads = [clause.head[1] for clause in clauses]

    def mentions(self, action: str) -> bool:
        """Whether it means something at some places only."""
        if self._moves:
            return any(isinstance(head, Variable) or head == action for head in self._heads)
        return any(action == known for known, _ in self._table)

    def meaning(self, action: str, destination: str | None, kb: KnowledgeBase, history: History = ()) -> str | None:
        """What the action means at this destination; as `contextualise`.

        Args:
            action: as it is recognised.
            destination: where it happened; None: that is not known.
            kb: the domain's, with what was seen by now.
            history: what was done earlier.

        Raises:
            DomainError: it means two things. Undefined: what it means is not known, with the reason.
        """
        if not self._moves:
            return contextualise(action, destination, self._table)
        if not self.mentions(action):
            return action
        return None if destination is None else _asked(action, destination, kb, history)


def _asked(action: str, destination: str, kb: KnowledgeBase, history: History) -> str | None:
    facts: list[tuple[str, str, str]] = []
    doubt = ""
    goal = Literal(Compound((CONTEXT[0], action, destination, _MEANING)))
    for solution in kb.solver(history=history).possible([goal]):
        if DOUBT in solution:
            doubt = doubt or str(solution[DOUBT])
        else:
            facts.append((action, destination, str(substitute(_MEANING, solution))))
    if not facts and doubt:
        raise Undefined(f"what {action} means at {destination} is not known: {doubt}")
    return as_table(facts).get((action, destination))


def skills_of(kb: KnowledgeBase) -> dict[str, str]:
    """By what actions are called in their contexts, the skills they are done by."""
    if not kb.looks_back_at(*CONTEXT):
        return {str(meaning): str(skill) for skill, _, meaning in kb.rows(*CONTEXT)}
    heads = (clause.head for clause in kb.clauses_of(CONTEXT))
    return {head[3]: head[1] for head in heads if isinstance(head[1], str) and isinstance(head[3], str)}


def context_table(rows: Rows) -> dict[tuple[str, str], str]:
    """Facts ``context(Action, Destination, Contextualised)`` as a table.

    Raises:
        DomainError: one action and destination with two meanings.
    """
    return as_table(rows(*CONTEXT))


def as_table(facts: Iterable[Sequence[str]]) -> dict[tuple[str, str], str]:
    """Rows of action, destination and meaning as a table.

    Raises:
        DomainError: one action and destination with two meanings.
    """
    table: dict[tuple[str, str], str] = {}
    for action, destination, meaning in facts:
        other = table.setdefault((action, destination), meaning)
        require(other == meaning, f"context({action}, {destination}, …) is both {other} and {meaning}")
    return table


def contextualise(action: str, destination: str | None, table: Mapping[tuple[str, str], str]) -> str | None:
    """What the action means at this destination (paper, table context).

    An action the table does not mention passes through; one it does mention is None where the destination is
    unknown or not in it.
    """
    if all(action != known for known, _ in table):
        return action
    return None if destination is None else table.get((action, destination))
