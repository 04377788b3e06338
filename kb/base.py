"""The knowledge base: facts, rules and constraints, with everything one can ask of them.

    >>> kb = KnowledgeBase.from_text("human(ann). agent(X) :- human(X).")
    >>> kb.ask("agent(ann)"), list(kb.query("agent(X)"))
    (True, [{'X': 'ann'}])
"""

from __future__ import annotations

import time
from collections.abc import Callable, Hashable, Iterator, Sequence
from dataclasses import replace
from difflib import get_close_matches
from functools import lru_cache
from itertools import islice
from typing import TYPE_CHECKING, Any, TypeAlias

from casper.kb.errors import BudgetExceeded, Undefined
from casper.kb.goals.goals import Predicate
from casper.kb.program.control import plain_query
from casper.kb.program.refusals import check_computable, check_defined, undefined_sentence
from casper.kb.reasons.doubt import Doubt, doubt_of
from casper.kb.reasons.proof import Proof
from casper.kb.reasons.repair import Repair, repairs
from casper.kb.reasons.validity import History, Verdict, valid_instances, verify
from casper.kb.reasons.why import prove
from casper.kb.reasons.why_not import Refusal, Violation, attempts
from casper.kb.relations.relation import Row
from casper.kb.store.clause_store import MOST_INDEXED, NO_HISTORY, ClauseStore, Statement, of_one_moment
from casper.kb.terms.clauses import SYSTEM, Clause, Indicator, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.terms.unification import Bindings, is_ground, substitute, variables_of
from casper.kb.terms.unknown import DOUBT, closed
from casper.kb.text.reader import read_query
from casper.kb.text.triples import triples_text
from casper.kb.top_down.compiled.cells import variant
from casper.kb.top_down.linking import Links
from casper.kb.top_down.plan import Plan, plan_of
from casper.kb.top_down.solve import DEFAULT_BUDGET

if TYPE_CHECKING:
    from casper.kb.relations.tables.answers import Answers

Asked: TypeAlias = tuple[tuple[Variable, ...], tuple[Literal, ...]]  # what is asked for, and the conditions
Doubted: TypeAlias = tuple[tuple[Variable, ...], Row, str]  # what is asked for, an undefined answer, and the reason
_query_of_text = lru_cache(maxsize=1024)(read_query)


class KnowledgeBase(ClauseStore):
    """Relations that answer in every direction, with reasons.

    Every question sees one state, whatever other threads change meanwhile; so do several questions of one `snapshot`.
    """

    # --- questions -------------------------------------------------------------------------------------------------

    def ask(self, statement: Statement) -> bool:
        """Whether the statement holds; with unknown parts, whether it holds for some value.

        Raises:
            ProgramError: nothing defines the predicate. BudgetExceeded: the answer is unknown.
            Undefined: it is neither true nor false, with the reason.
        """
        try:
            if statement in self._true:
                return True
            if statement in self._false:
                return False
        except TypeError:  # not hashable, so no statement: `_asked` says so
            return self._asked(statement)
        false = self._false
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
        ended, found = self._ended, None
        relation = (self._cached or self._model).at_hand.get((statement[0], len(statement) - 1))
        if relation is not None:
            row = statement[1:]
            found = row in relation
            if not found:
                for value in row:
                    if type(value) is not str:  # a row of names is not there; of others it depends on what they are
                        atom = self._statement(statement)
                        found = atom.args in relation if is_ground(atom) else None
                        break
                if not found and relation.undefined is not None:
                    found = None
        if self._begun != ended:  # somebody was half-way through a change: once more, when they are done
            with self.lock:
                return self._asked(statement)
        return self._searched(statement) if found is None else found

    @of_one_moment
    def _searched(self, statement: Statement) -> bool:
        """Whether some instance is found; where that is too far to search for, what follows is listed first."""
        atom, model = self._statement(statement), self._model
        try:
            return next(self.instances(atom), None) is not None
        except BudgetExceeded:
            if model.listed is not None or not model.keeps(atom.indicator):
                raise
            _ = model.relations
            return next(self.instances(atom), None) is not None

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

    def _index(self) -> None:
        """One set of every stored statement that holds, where there are not too many: the fast way to a yes."""
        with self.lock:
            self._index_in, listed = None, self._model.listed
            if listed is not None and sum(map(len, listed.values())) <= MOST_INDEXED:
                stored = listed.items()
                self._true = {(name, *row) for (name, _), relation in stored for row in relation}

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
            ReadError, ProgramError, BudgetExceeded.
            Undefined: after the last true answer, when there are undefined ones.
        """
        alternatives, inner = self._plain_query(goal)
        answers = self._answers(alternatives, inner, limit, timeout, budget, cancelled, undefined)
        return ({name: value for name, value in zip(names, row)} for names, row in answers)

    @of_one_moment
    def plan(self, goal: str) -> Plan:
        """How a query would be answered: each condition's turn, index and method, and those of the rules behind it.

        Raises:
            ReadError, ProgramError: as `query`.
        """
        links, (alternatives, inner) = self._model.links, self._plain_query(goal)
        if inner:
            links = Links(links.relations, links.code.extended(inner), links.computed)
        return plan_of([links.code.query(body) for _, body in alternatives], links)

    def _plain_query(self, goal: str) -> tuple[list[Asked], dict[Indicator, tuple[Clause, ...]]]:
        """The alternatives of a query, each with what it asks for, and the clauses of goals inside it."""
        known: dict[Indicator, tuple[Clause, ...]] = {}
        alternatives: list[Asked] = []
        asked = _query_of_text(goal)
        everyone = dict.fromkeys(v for body in asked for x in body for v in x.variables())
        for number, written in enumerate(asked):
            here = {v for x in written for v in x.variables()}
            named = [v for v in everyone if v in here and not v.name.startswith("_")]
            bodies, clauses = plain_query(written, f"asked {number} ")
            alternatives.extend((tuple(named), body) for body in bodies)
            for clause in clauses:
                known[clause.head.indicator] = (*known.get(clause.head.indicator, ()), clause)
        everything = {**self._model.program.clauses, **known} if known else self._model.program.clauses
        for body in (*(body for _, body in alternatives), *(c.body for found in known.values() for c in found)):
            for literal in body:
                check_defined(literal, everything)
                check_computable(literal)
        return alternatives, known

    def _answers(
        self,
        alternatives: list[Asked],
        inner: dict[Indicator, tuple[Clause, ...]],
        limit: int | None,
        timeout: float | None,
        budget: int,
        cancelled: Callable[[], bool] | None,
        undefined: bool,
    ) -> Iterator[tuple[list[str], Row]]:
        if limit is not None and limit <= 0:
            return
        seen: set[Hashable] = set()
        doubts: dict[Hashable, Doubted] = {}
        solver = self.solver(budget)
        solver.deadline = None if timeout is None else time.monotonic() + timeout
        solver.cancelled = cancelled
        solver = solver.with_inner(inner)
        for variables, body in alternatives:
            names = [variable.name for variable in variables]
            for row, doubt in solver.rows(body, variables):
                key = variables, variant(row)
                if doubt:
                    doubts.setdefault(key, (variables, row, doubt))
                elif key not in seen:
                    seen.add(key)
                    if not undefined:
                        yield names, row
                        if len(seen) == limit:  # the next answer may be far away
                            return
        left = [doubt for key, doubt in doubts.items() if key not in seen]
        if undefined:
            yield from (([v.name for v in variables], row) for variables, row, _ in islice(left, limit))
        elif left and (limit is None or len(seen) < limit):
            raise Undefined(_undefined_answers(left))

    @of_one_moment
    def instances(self, statement: Statement) -> Iterator[Compound]:
        """Every instance of one atom that holds, lazily, each once; a part that may be anything stays a variable.

        Raises:
            Undefined: after the last one, when some other instance is undefined.
        """
        atom = self._statement(statement)
        self.check_known(atom.indicator)
        seen: set[Hashable] = set()
        doubts: dict[Hashable, Compound] = {}
        names = list(variables_of(atom))
        parts = [(part, is_ground(part)) for part in atom]  # a long list is not copied for every answer
        for row, doubt in self.solver().rows([Literal(atom)], names):
            values: Bindings = {name: value for name, value in zip(names, row) if value is not name}
            instance = Compound([part if is_closed else substitute(part, values) for part, is_closed in parts])
            key = variant(row)
            if doubt:
                doubts.setdefault(key, instance)
            elif key not in seen:
                seen.add(key)
                yield instance
        doubtful = next((instance for key, instance in doubts.items() if key not in seen), None)
        if doubtful is not None:
            raise Undefined((doubt_of(doubtful, self.solver()) or Doubt(doubtful)).sentence)

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

        One atom of a stored predicate is read off its rows; those of a large program never become Python tuples. Any
        other query is answered as by `query`, which also says what the arguments mean and what is raised.
        """
        from casper.kb.relations.tables.answers import of_answers, of_stored  # numpy is loaded for those who ask for it

        answers = self.query(goal, timeout=timeout, budget=budget, cancelled=cancelled)  # checks the goal; lazy
        alternatives = _query_of_text(goal)
        if len(alternatives) == 1 and len(alternatives[0]) == 1:
            [literal] = alternatives[0]
            relation = None if literal.negated or literal.is_comparison else self.stored(literal.atom.indicator)
            settled = relation is not None and relation.undefined is None
            found = of_stored(literal.atom, relation) if relation is not None and settled else None
            if found is not None:
                return found
        variables = dict.fromkeys(v.name for body in alternatives for literal in body for v in literal.variables())
        return of_answers([name for name in variables if not name.startswith("_")], answers)

    def facts(self, name: str, rows: Any, *, header: bool = True) -> None:
        """Load many facts of one predicate: ``kb.facts("edge", [("a", "b"), ("b", "c")])``, ``kb.facts("edge", path)``.

        Args:
            name: the predicate; its arity is the number of columns.
            rows: rows of constants, a numpy array (one or two dimensions, or structured), a pandas data frame, an Arrow
                table, or the path of a ``.csv``, ``.tsv`` or ``.parquet`` file.
            header: whether the first line of a CSV file names the columns.

        Raises:
            ProgramError: rows of different lengths, or something in them that is no constant, with row and column.
            ReadError: a file that cannot be read, with its line. CasperError: the library for it is not installed.
        """
        from casper.kb.relations.tables.sources import rows_of

        found, columns = rows_of(rows, header)
        if columns is not None:  # defined even without a row
            with self._changing():
                self._dynamic.add((name, columns))
                self._forget()
        super().facts(name, found)

    # --- reasons ---------------------------------------------------------------------------------------------------

    @of_one_moment
    def why(self, statement: Statement) -> Proof | Doubt | None:
        """A proof of the statement (of its first instance, where it has unknown parts), or None when it fails.

        Of a statement that is undefined, the circle or the failed evaluation that makes it so.
        """
        atom = self._statement(statement)
        self.check_known(atom.indicator)
        _ = self._model.relations  # reasons are told of what is listed
        try:
            if not is_ground(atom):
                first = next((a for a in self.instances(atom) if is_ground(a)), None)
                if first is None:
                    return None
                atom = first
            proof = prove(atom, self._model.proofs, self.solver(), self._model.given, self._model.program.strata)
        except Undefined:
            proof = None
        return proof or doubt_of(atom, self.solver())

    @of_one_moment
    def why_not(self, statement: Statement, history: History = NO_HISTORY) -> Refusal | None:
        """Why the statement is not provable or not valid; None when it is both."""
        atom = self._statement(statement)
        if atom.indicator == ("valid", 1) and isinstance(atom[1], (str, tuple)):
            return self.why_not(predication(atom[1]), history)
        if atom.indicator not in self._model.program.clauses:
            return Refusal(atom, undefined=self._undefined(atom.indicator))
        history = self._history(history)
        relation = self._model.relations.get(atom.indicator)  # reasons are told of what is listed
        if relation is not None and atom.args in relation:  # ground, so only constraints can object
            violations = tuple(self._violations(atom, history))
            return Refusal(atom, (), violations, provable=True) if violations else None
        is_listed = relation is not None and relation.undefined is None and is_ground(atom)  # then it is no row: false
        provable = None if is_listed else next(self.solver(history=history).solve([Literal(atom)]), None)
        if provable is None:
            tried = tuple(attempts(atom, self._model.program.clauses[atom.indicator], self.solver(history=history)))
            doubt = None if is_listed else doubt_of(atom, self.solver(history=history))
            violations = tuple(self._violations(atom, history) if is_ground(atom) else ())
            return Refusal(atom, tried, violations, doubt="" if doubt is None else doubt.sentence)
        try:
            if next(valid_instances(atom, self.solver(history=history), self._model.constraints), None) is not None:
                return None
        except Undefined:
            pass
        return Refusal(atom, (), tuple(self._violations(substitute(atom, provable), history)), provable=True)

    def _violations(self, atom: Compound, history: History) -> list[Violation]:
        """The constraints that are broken; where none is, those that may be."""
        found = list(self._model.constraints.judged(atom, self.solver(history=history)))
        return [v for v in found if not v.doubt] or found

    def _history(self, history: History) -> History:
        return [(self._statement(statement), seconds) for statement, seconds in history]

    @of_one_moment
    def verify(self, statement: Statement, history: History = NO_HISTORY) -> Verdict:
        """Judge a statement: provable, and no constraint broken when it is claimed after the history.

        A statement whose predicate nobody defines is invalid, with a reason; it is not an error.
        """
        atom = self._statement(statement)
        if atom.indicator not in self._model.program.clauses:
            return Verdict(atom, False, atom, Refusal(atom, undefined=self._undefined(atom.indicator)))
        history, constraints = self._history(history), self._model.constraints  # which may list: before the search
        verdict = verify(atom, self.solver(history=history), constraints)
        if verdict.valid is None:
            return self._with_reason(verdict, history)
        if verdict.valid:
            return verdict
        return Verdict(atom, False, atom, self.why_not(atom, history))

    def _with_reason(self, verdict: Verdict, history: History) -> Verdict:
        """An unknown verdict with the whole reason, where the statement itself is undefined."""
        try:
            doubt = doubt_of(verdict.statement, self.solver(history=history))
        except BudgetExceeded:
            return verdict
        return verdict if doubt is None else replace(verdict, remark=doubt.sentence)

    @of_one_moment
    def repair(self, statement: Statement, history: History = NO_HISTORY, limit: int = 3) -> list[Repair]:
        """The smallest changes of base facts that make the statement valid; none for one that is, or beyond mending."""
        return repairs(self, self._statement(statement), history, limit)

    @of_one_moment
    def broken(self) -> Sequence[Violation]:
        """The constraints that the facts alone break."""
        return self._model.constraints.always

    def changed(self, repair: Repair) -> KnowledgeBase:
        """A copy of the knowledge base with facts added and removed; this one stays as it is."""
        return self.assume(*sorted(repair.add, key=repr), without=repair.remove)

    # --- as RDF ----------------------------------------------------------------------------------------------------

    def to_rdf(self, derived: bool = False) -> str:
        """The stated facts as N-Triples (which is Turtle, too); with ``derived``, all that follows from them as well.

        A text that was imported from an ontology has its IRIs in iri/2, and gives its individuals back; a name without
        an IRI is under ``urn:casper:``. Predicates that are answered top-down have only their stated facts.
        """
        iris = {str(name): str(iri) for name, iri in self.rows("iri", 2)}
        data = {str(name) for (name,) in self.rows("data_property", 1)}
        datatypes = {str(name): str(datatype) for name, datatype in self.rows("datatype", 2)}
        stated = ((c.head.indicator, c.head.args) for c in self.clauses if not c.body and is_ground(c.head))
        rows = dict.fromkeys(stated)
        if derived:
            for indicator, relation in self._model.relations.items():
                rows.update(((indicator, tuple(row)), None) for row in relation)
        about = {("iri", 2), ("data_property", 1), ("datatype", 2)} if iris else set()
        facts = sorted(((i, row) for i, row in rows if i not in about), key=repr)
        return triples_text(((name, row) for (name, _), row in facts), iris, data, datatypes)

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


def _undefined_answers(left: Sequence[Doubted]) -> str:
    """The sentence for answers that are undefined."""
    variables, row, reason = left[0]
    shown = ", ".join(f"{v.name} = {term_text(closed(value))}" for v, value in zip(variables, row)) or "the answer"
    more = f" and {len(left) - 1} more" if len(left) > 1 else ""
    return f"{shown}{more} {'are' if more else 'is'} undefined: {reason}"
