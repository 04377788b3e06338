"""The knowledge base: facts, rules and constraints, with everything one can ask of them.

    >>> kb = KnowledgeBase.from_text("human(ann). agent(X) :- human(X).")
    >>> kb.ask("agent(ann)"), list(kb.query("agent(X)"))
    (True, [{'X': 'ann'}])
"""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable, Iterator, Sequence
from difflib import get_close_matches
from functools import lru_cache

from casper.kb.errors import BudgetExceeded
from casper.kb.goals.goals import Predicate
from casper.kb.program.refusals import check_defined, undefined_sentence
from casper.kb.reasons.proof import Proof
from casper.kb.reasons.repair import Repair, repairs
from casper.kb.reasons.validity import History, Verdict, valid_instances, verify
from casper.kb.reasons.why import prove
from casper.kb.reasons.why_not import Refusal, Violation, attempts
from casper.kb.relations.relation import Row
from casper.kb.store.clause_store import MOST_INDEXED, NO_HISTORY, ClauseStore, Statement
from casper.kb.store.model import Model
from casper.kb.terms.clauses import SYSTEM, Indicator, Literal
from casper.kb.terms.terms import Compound, Term, Variable, predication
from casper.kb.terms.unification import is_ground, substitute, variables_of
from casper.kb.text.reader import read_query
from casper.kb.top_down.compiled.cells import variant
from casper.kb.top_down.plan import Plan, plan_of
from casper.kb.top_down.search import DEFAULT_BUDGET

_query_of_text = lru_cache(maxsize=1024)(read_query)


class KnowledgeBase(ClauseStore):
    """Relations that answer in every direction, with reasons."""

    # --- questions -------------------------------------------------------------------------------------------------

    def ask(self, statement: Statement) -> bool:
        """Whether the statement holds; with unknown parts, whether it holds for some value.

        Raises:
            ProgramError: nothing defines the predicate. BudgetExceeded: the answer is unknown.
        """
        try:
            if statement in self._true:
                return True
            if statement in self._false:
                return False
        except TypeError:  # not hashable, so no statement: `_asked` says so
            return self._asked(statement)
        found = self._asked(statement)
        if not found and len(self._false) < MOST_INDEXED:
            self._false.add(statement)
        return found

    def _asked(self, statement: Statement) -> bool:
        """What the index of true statements does not know."""
        model = self._cached or self._model
        if self._index_in is not None:
            self._index_in -= 1
            if self._index_in < 0:
                self._index(model)
        if isinstance(statement, str):
            statement = self._statement(statement)
        relation = model.at_hand.get((statement[0], len(statement) - 1))
        if relation is not None:
            row = statement[1:]
            if row in relation:
                return True
            for value in row:
                if type(value) is not str:
                    break
            else:
                return False  # every part is a name, so there is nothing to look for
        atom = self._statement(statement)
        if relation is not None and is_ground(atom):
            return atom.args in relation
        try:
            return next(self.instances(atom), None) is not None
        except BudgetExceeded:
            if model.listed is not None or not model.keeps(atom.indicator):
                raise
            _ = model.relations  # top-down went too far: list what follows, and look there
            return next(self.instances(atom), None) is not None

    def _index(self, model: Model) -> None:
        """One set of every stored statement that holds, where there are not too many: the fast way to a yes."""
        self._index_in = None
        if model.listed is not None and sum(map(len, model.listed.values())) <= MOST_INDEXED:
            stored = model.listed.items()
            self._true = {(name, *row) for (name, _), relation in stored for row in relation}

    def query(
        self,
        goal: str,
        limit: int | None = None,
        *,
        timeout: float | None = None,
        budget: int = DEFAULT_BUDGET,
        cancelled: Callable[[], bool] | None = None,
    ) -> Iterator[dict[str, Term]]:
        """Answers to a conjunction (``eat(A, T, D), \\+ D = sink``) in any direction, lazily, each once.

        An answer maps the goal's named variables to their values; a part that may be anything is a `Variable`.

        Args:
            goal: conditions, as in the body of a rule.
            limit: stop after so many answers.
            timeout: seconds from the first answer's search on, after which the rest is unknown.
            budget: resolution steps after which the rest is unknown.
            cancelled: asked now and then; when it says True the search stops (a thread's ``event.is_set``, say).

        Raises:
            ReadError, ProgramError, BudgetExceeded.
        """
        alternatives = _query_of_text(goal)
        for literal in (x for body in alternatives for x in body):
            check_defined(literal, self._model.program.clauses)
        return self._answers(alternatives, limit, timeout, budget, cancelled)

    def plan(self, goal: str) -> Plan:
        """How a query would be answered: each condition's turn, index and method, and those of the rules behind it.

        Raises:
            ReadError, ProgramError: as `query`.
        """
        links, alternatives = self._model.links, _query_of_text(goal)
        for literal in (x for body in alternatives for x in body):
            check_defined(literal, self._model.program.clauses)
        return plan_of([links.code.query(body) for body in alternatives], links)

    def _answers(
        self,
        alternatives: tuple[tuple[Literal, ...], ...],
        limit: int | None,
        timeout: float | None,
        budget: int,
        cancelled: Callable[[], bool] | None,
    ) -> Iterator[dict[str, Term]]:
        if limit is not None and limit <= 0:
            return
        seen: set[Hashable] = set()
        solver, code = self.solver(budget), self._model.links.code
        solver.deadline = None if timeout is None else time.monotonic() + timeout
        solver.cancelled = cancelled
        for body in alternatives:
            names = [v for v in dict.fromkeys(v for x in body for v in x.variables()) if not v.name.startswith("_")]
            shown = [name.name for name in names]
            for row in solver.rows(code.query(body), names):
                key = variant(row)
                if key not in seen:
                    seen.add(key)
                    yield dict(zip(shown, row))
                    if len(seen) == limit:  # the next answer may be far away
                        return

    def instances(self, statement: Statement) -> Iterator[Compound]:
        """Every instance of one atom that holds, lazily, each once; a part that may be anything stays a variable."""
        atom = self._statement(statement)
        self.check_known(atom.indicator)
        seen: set[Hashable] = set()
        names = list(variables_of(atom))
        closed = [is_ground(part) for part in atom]  # a long list is not copied for every answer
        plain = all(is_closed or isinstance(part, Variable) for part, is_closed in zip(atom, closed))
        for row in self.solver().rows([Literal(atom)], names):
            key = variant(row)
            if key not in seen:
                seen.add(key)
                found = {name: value for name, value in zip(names, row) if value is not name}
                if plain:
                    yield Compound([p if is_closed else found.get(p, p) for p, is_closed in zip(atom, closed)])
                    continue
                yield Compound([p if is_closed else substitute(p, found) for p, is_closed in zip(atom, closed)])

    def rows(self, name: str, arity: int) -> Iterator[Row]:
        """The rows of a predicate as tuples of constants; none when it is not defined."""
        if (name, arity) in self._model.program.clauses:
            relation = self._model.relations.get((name, arity))
            if relation is not None:
                yield from list(relation)
            else:
                pattern = Compound([name, *(Variable(f"X{at}") for at in range(arity))])
                yield from (answer.args for answer in self.instances(pattern) if is_ground(answer))

    # --- reasons ---------------------------------------------------------------------------------------------------

    def why(self, statement: Statement) -> Proof | None:
        """A proof of the statement (of its first instance, where it has unknown parts), or None when it fails."""
        atom = self._statement(statement)
        self.check_known(atom.indicator)
        if not is_ground(atom):
            first = next((a for a in self.instances(atom) if is_ground(a)), None)
            if first is None:
                return None
            atom = first
        return prove(atom, self._model.proofs, self.solver(), self._model.given)

    def why_not(self, statement: Statement, history: History = NO_HISTORY) -> Refusal | None:
        """Why the statement is not provable or not valid; None when it is both."""
        atom = self._statement(statement)
        if atom.indicator == ("valid", 1) and isinstance(atom[1], (str, tuple)):
            return self.why_not(predication(atom[1]), history)
        if atom.indicator not in self._model.program.clauses:
            return Refusal(atom, undefined=self._undefined(atom.indicator))
        history = self._history(history)
        relation = self._model.relations.get(atom.indicator)
        if relation is not None and atom.args in relation:  # ground, so only constraints can object
            violations = tuple(self._violations(atom, history))
            return Refusal(atom, (), violations, provable=True) if violations else None
        provable = next(self.solver(history=history).solve([Literal(atom)]), None)
        if provable is None:
            tried = tuple(attempts(atom, self._model.program.clauses[atom.indicator], self.solver(history=history)))
            return Refusal(atom, tried, tuple(self._violations(atom, history) if is_ground(atom) else ()))
        if next(valid_instances(atom, self.solver(history=history), self._model.constraints), None) is not None:
            return None
        return Refusal(atom, (), tuple(self._violations(substitute(atom, provable), history)), provable=True)

    def _violations(self, atom: Compound, history: History) -> Iterator[Violation]:
        return self._model.constraints.broken_by(atom, self.solver(history=history))

    def _history(self, history: History) -> History:
        return [(self._statement(statement), seconds) for statement, seconds in history]

    def verify(self, statement: Statement, history: History = NO_HISTORY) -> Verdict:
        """Judge a statement: provable, and no constraint broken when it is claimed after the history.

        A statement whose predicate nobody defines is invalid, with a reason; it is not an error.
        """
        atom = self._statement(statement)
        if atom.indicator not in self._model.program.clauses:
            return Verdict(atom, False, atom, Refusal(atom, undefined=self._undefined(atom.indicator)))
        history = self._history(history)
        verdict = verify(atom, self.solver(history=history), self._model.constraints)
        if verdict.valid is not False:
            return verdict
        return Verdict(atom, False, atom, self.why_not(atom, history))

    def repair(self, statement: Statement, history: History = NO_HISTORY, limit: int = 3) -> list[Repair]:
        """The smallest changes of base facts that make the statement valid; none for one that is, or beyond mending."""
        return repairs(self, self._statement(statement), history, limit)

    def broken(self) -> Sequence[Violation]:
        """The constraints that the facts alone break."""
        return self._model.constraints.always

    def changed(self, repair: Repair) -> KnowledgeBase:
        """A copy of the knowledge base with facts added and removed; this one stays as it is."""
        return self.assume(*sorted(repair.add, key=repr), without=repair.remove)

    # --- by name ---------------------------------------------------------------------------------------------------

    def __getattr__(self, name: str) -> Predicate:
        """A predicate by its name, to be used as a kanren goal constructor: ``kb.eat(x, "biscuits", "plate")``."""
        if name.startswith("_"):
            raise AttributeError(name)
        found = self.__dict__[name] = self.predicate(name)  # the next look finds it without coming here
        return found

    def predicate(self, name: str) -> Predicate:
        """A predicate by its name, also one that is called like a method of this class.

        Raises:
            AttributeError: nothing defines the name.
        """
        known = self._model.program.clauses
        if all(name != defined for defined, _ in (*known, *SYSTEM)):
            raise AttributeError(undefined_sentence((name, 0), known))
        return Predicate(self, name)

    def _undefined(self, indicator: Indicator) -> str:
        """Why a statement whose predicate nobody defines is invalid, with what may have been meant."""
        known = list(self._statements) or list(self._model.program.clauses)
        name, arity = indicator
        if any(name == other for other, _ in known):
            return undefined_sentence(indicator, known)
        close = get_close_matches(name, sorted({other for other, _ in known}), n=1)
        return f"there is no action {name}/{arity} here" + (f"; did you mean {close[0]}?" if close else "")
