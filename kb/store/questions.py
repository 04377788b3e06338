"""What is asked of a knowledge base, without reasons: truth, answers in any direction, rows and tables."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from typing import TYPE_CHECKING

from casper.kb.errors import BudgetExceeded, ProgramError, Undefined
from casper.kb.program.refusals import undefined_sentence
from casper.kb.relations.relation import Relation, Row
from casper.kb.store.clause_store import ClauseStore
from casper.kb.store.known import MOST_INDEXED, Statement, known_of, looked_up
from casper.kb.store.queries import answers, conditions_of, instances, plan_of_query, table_of
from casper.kb.store.versioned import of_one_moment
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM, Indicator, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.terms.unification import is_ground
from casper.kb.terms.unknown import DOUBT
from casper.kb.top_down.plan import Plan
from casper.kb.top_down.solve import DEFAULT_BUDGET

if TYPE_CHECKING:
    from casper.kb.relations.tables.answers import Answers


class Questions(ClauseStore):
    """Facts, rules and constraints that can be asked; every question sees one state."""

    def ask(self, statement: Statement) -> bool:
        """Whether the statement holds; with unknown parts, whether it holds for some value.

        Raises:
            ProgramError: nothing defines the predicate. BudgetExceeded: the answer is unknown.
            Undefined: it is neither true nor false, with the reason.
        """
        try:
            known = self._known
            if statement in known.true:
                return True
            if (
                type(statement) is not str
                and len(statement) == known.lengths.get(statement[0])
                and known.constants.issuperset(statement)
            ):
                return False
            false = self._false
            if statement in false:
                return False
        except (TypeError, IndexError):  # not hashable, or empty, so no statement: `_asked` says so
            return self._asked(predication(statement))
        found = self._asked(statement)
        if not found and false is self._false and len(false) < MOST_INDEXED:  # nothing has begun to change since
            false.add(statement)
        return found

    def _asked(self, statement: Statement) -> bool:
        """What the index of true statements does not know."""
        if isinstance(statement, str):
            statement = self._statement(statement)
        left = self._index_in
        if left is not None:
            self._index_in = left - 1
            if left <= 0:
                self._index()
        ended = self._ended
        found = looked_up(statement, (self._cached or self._model).at_hand)
        if self._begun != ended:  # somebody was half-way through a change: once more, when they are done
            with self.lock:
                return self._asked(statement)
        return self._searched(statement) if found is None else found

    def _index(self) -> None:
        """One set of every stored statement that holds: the fast way to a yes, and to most of the noes."""
        with self.lock:
            self._index_in, listed = None, self._model.listed
            if listed is not None:
                self._known = known_of(listed)

    @of_one_moment
    def _searched(self, statement: Statement) -> bool:
        """Whether some instance is found; where that is too far to search for, what follows is listed first."""
        atom, model = self._statement(statement), self._model
        try:
            return next(instances(atom, self.solver), None) is not None
        except BudgetExceeded:
            if model.listed is not None or not model.keeps(atom.indicator):
                raise
            _ = model.relations
            return next(instances(atom, self.solver), None) is not None

    @of_one_moment
    def truth(self, statement: Statement) -> str:
        """``"true"``, ``"false"`` or ``"undefined"``; with unknown parts, whether it is so for some value.

        Raises:
            ProgramError: nothing defines the predicate. BudgetExceeded: the answer is unknown.
        """
        atom = self._statement(statement)
        self.check_known(atom.indicator)
        truth = "false"
        for solution in self.solver().possible([Literal(atom)]):
            if DOUBT not in solution:
                return "true"
            truth = "undefined"
        return truth

    @of_one_moment
    def query(
        self,
        goal: str,
        limit: int | None = None,
        *,
        timeout: float | None = None,
        budget: int = DEFAULT_BUDGET,
        cancelled: Callable[[], bool] | None = None,
        undefined: bool = False,
    ) -> Iterator[dict[str, Term]]:
        """Answers to a conjunction (``eat(A, T, D), \\+ D = sink``) in any direction, lazily, each once.

        An answer maps the goal's named variables to their values; a part that may be anything is a `Variable`.

        Args:
            goal: conditions, as in the body of a rule.
            limit: stop after so many answers.
            timeout: seconds from the first answer's search on, after which the rest is unknown.
            budget: resolution steps after which the rest is unknown.
            cancelled: asked now and then; when it says True the search stops (a thread's ``event.is_set``, say).
            undefined: give the answers that are neither true nor false instead.

        Raises:
            ReadError, ProgramError: the text is no question, or nothing defines a predicate in it.
            BudgetExceeded: the rest is unknown.
            Undefined: after the last true answer, when there are undefined ones.
        """
        query, solver = self._model.query(goal), self.solver(budget)
        solver.cancelled = cancelled
        return answers(query, solver, limit, timeout, undefined)

    @of_one_moment
    def plan(self, goal: str) -> Plan:
        """How a query would be answered: each condition's turn, index and method, and those of the rules behind it.

        Raises:
            ReadError, ProgramError: as `query`.
        """
        return plan_of_query(self._model.query(goal), self._model.links)

    @of_one_moment
    def instances(self, statement: Statement) -> Iterator[Compound]:
        """Every instance of one atom that holds, lazily, each once; a part that may be anything stays a variable.

        Raises:
            Undefined: after the last one, when some other instance is undefined.
        """
        atom = self._statement(statement)
        self.check_known(atom.indicator)
        return instances(atom, self.solver)

    @of_one_moment
    def rows(self, name: str, arity: int) -> Iterator[Row]:
        """The rows of a predicate as tuples of constants; none when it is not defined.

        Raises:
            Undefined: after the last one, when some other row is undefined.
        """
        if (name, arity) in self._model.program.clauses:
            relation = self._model.relations.get((name, arity))
            if relation is not None:
                yield from list(relation)
                for row in relation.undefined or ():
                    raise Undefined(f"{term_text(as_term(Compound((name, *row))))} is undefined")
            else:
                pattern = Compound([name, *(Variable(f"X{at}") for at in range(arity))])
                yield from (answer.args for answer in self.instances(pattern) if is_ground(answer))

    @of_one_moment
    def table(
        self,
        goal: str,
        *,
        timeout: float | None = None,
        budget: int = DEFAULT_BUDGET,
        cancelled: Callable[[], bool] | None = None,
    ) -> Answers:
        """All answers to a query as columns: ``kb.table("eat(A, T, D)").columns["A"]`` is an array.

        One atom of a stored predicate is read off its rows, and many answers over stored rows are joined on columns:
        none of them becomes a Python tuple. Any other query is answered as by `query`, which also says what the
        arguments mean and what is raised; besides, `BudgetExceeded` says that there are too many answers for a table.
        """
        from casper.kb.relations.tables.answers import of_answers, of_stored  # numpy is loaded for those who ask for it

        found_later = self.query(goal, timeout=timeout, budget=budget, cancelled=cancelled)  # checks the goal; lazy
        alternatives = conditions_of(goal)
        if len(alternatives) == 1 and len(alternatives[0]) == 1:
            [literal] = alternatives[0]
            relation = None if literal.negated or literal.is_comparison else self.stored(literal.atom.indicator)
            found = None if relation is None or relation.undefined is not None else of_stored(literal.atom, relation)
            if found is not None:
                return found
        solver = self.solver(budget)
        solver.cancelled = cancelled
        joined = table_of(self._model.query(goal), solver, timeout)
        if joined is not None:
            return joined
        variables = dict.fromkeys(v.name for body in alternatives for literal in body for v in literal.variables())
        return of_answers([name for name in variables if not name.startswith("_")], found_later)

    # --- what there is ---------------------------------------------------------------------------------------------

    def defines(self, name: str, arity: int) -> bool:
        """Whether a predicate has clauses here or is declared dynamic."""
        return (name, arity) in self._model.program.clauses

    @property
    def depends_on_history(self) -> bool:
        """Whether a rule or constraint looks at did/2: otherwise what happened earlier changes no verdict."""
        return self._model.program.looks_back

    def looks_back_at(self, name: str, arity: int) -> bool:
        """Whether answers of a predicate may depend on what happened earlier, or on what is claimed."""
        return (name, arity) in self._model.program.situational

    def check_known(self, indicator: Indicator) -> None:
        """Refuse a predicate nobody defines.

        Raises:
            ProgramError: with what may have been meant.
        """
        if indicator not in SYSTEM and indicator not in BUILTINS and indicator not in self._model.program.clauses:
            raise ProgramError(undefined_sentence(indicator, self._model.program.clauses))

    def stored(self, indicator: Indicator) -> Relation | None:
        """The relation of a predicate whose rows are all at hand; None for one that is answered top-down for now.

        It follows the changes: other threads read it under ``lock``, or ask a snapshot for it.
        """
        return (self._cached or self._model).at_hand.get(indicator)
