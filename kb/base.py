"""The knowledge base: facts, rules and constraints, with everything one can ask of them.

    >>> kb = KnowledgeBase.from_text("human(ann). agent(X) :- human(X).")
    >>> kb.ask("agent(ann)"), list(kb.query("agent(X)"))
    (True, [{'X': 'ann'}])
"""

from __future__ import annotations

import time
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from difflib import get_close_matches
from functools import lru_cache
from typing import TypeAlias

from casper.kb.clauses import Clause, Directive, Literal, Sentence
from casper.kb.errors import ProgramError
from casper.kb.goals import Predicate
from casper.kb.model import Model
from casper.kb.program import SYSTEM, Indicator, check_defined, undefined_sentence
from casper.kb.proof import Proof
from casper.kb.reader import read_query, read_statement, read_text
from casper.kb.relation import Relation, Row
from casper.kb.repair import Repair, repairs
from casper.kb.solve import DEFAULT_BUDGET, Computed, Solver
from casper.kb.terms import Compound, Term, Variable, as_term, is_ground, predication, substitute, unify
from casper.kb.validity import History, Verdict, valid_instances, verify, with_history
from casper.kb.why import prove
from casper.kb.why_not import Refusal, Violation, attempts
from casper.kb.writer import program_text, term_text

Statement: TypeAlias = str | tuple[Term, ...]  # text, or a Compound / a tuple that starts with the name
_EMPTY: History = ()
_MISSING = object()
MOST_INDEXED = 20_000  # statements up to which all that hold are kept in one set
_statement_of_text = lru_cache(maxsize=4096)(read_statement)
_query_of_text = lru_cache(maxsize=1024)(read_query)


class KnowledgeBase:
    """Relations that answer in every direction, with reasons."""

    def __init__(self, clauses: Iterable[Clause] = (), dynamic: Iterable[Indicator] = ()) -> None:
        self._clauses: dict[Clause, None] = dict.fromkeys(clauses)  # in the author's order, each once
        self._bulk: dict[Indicator, dict[Row, None]] = {}
        self._dynamic: set[Indicator] = set(dynamic)
        self._statements: dict[Indicator, None] = {}
        self._cached: Model | None = None
        self._true: set[Statement] = set()  # stored statements that hold, once they are indexed
        self._index_in: int | None = 0  # questions until they are

    # --- authoring -------------------------------------------------------------------------------------------------

    @classmethod
    def from_text(cls, text: str, file: str = "<text>") -> KnowledgeBase:
        """A knowledge base from the language's text.

        Raises:
            ReadError, ProgramError: with the place of the first mistake.
        """
        base = cls()
        base.add(read_text(text, file))
        base.compile()
        return base

    def add(self, sentences: Iterable[Sentence]) -> None:
        """Add clauses and ``:- dynamic(name/arity).`` declarations; productions are the plan library's, not ours.

        Raises:
            ProgramError: a directive nobody knows, or a production.
        """
        self._forget()
        for sentence in sentences:
            if isinstance(sentence, Clause):
                self._clauses.setdefault(sentence)
            elif isinstance(sentence, Directive):
                self._dynamic.add(_dynamic(sentence))
            else:
                raise ProgramError("a plan (-->) belongs in a plan library, not in a knowledge base", sentence.place)

    def fact(self, fact: Statement) -> None:
        """State a fact: ``kb.fact("food(biscuits)")`` or ``kb.fact(("food", "biscuits"))``.

        Raises:
            ProgramError: the fact has a variable.
        """
        head = self._statement(fact)
        if not is_ground(head):
            raise ProgramError(f"{term_text(as_term(head))} has a variable; state a rule for what holds of everything")
        self.add([Clause(head)])

    def rule(self, text: str) -> None:
        """State a rule or a constraint in the language's syntax, with or without its full stop."""
        self.add(read_text(text if text.rstrip().endswith(".") else f"{text}."))

    def declare_statements(self, statements: Iterable[Indicator]) -> None:
        """Name the predicates that are action statements: what ``valid(S)`` enumerates when S is unknown."""
        self._statements.update(dict.fromkeys(statements))

    def compile(self) -> None:
        """Check, stratify and materialise now instead of at the first question.

        Raises:
            ProgramError: see `kb.program.analyse`.
        """
        _ = self._model

    @property
    def clauses(self) -> Sequence[Clause]:
        """Every clause, in the author's order, then the facts that were loaded in bulk."""
        loaded = (Clause(Compound((name, *row))) for (name, _), rows in self._bulk.items() for row in rows)
        return (*self._clauses, *loaded)

    def to_text(self) -> str:
        """The clauses as text that reads in as the same model."""
        declared = [Directive(Compound(("dynamic", Compound(("/", *i))))) for i in sorted(self._dynamic)]
        return program_text([*declared, *self.clauses])

    # --- questions -------------------------------------------------------------------------------------------------

    def ask(self, statement: Statement) -> bool:
        """Whether the statement holds; with unknown parts, whether it holds for some value.

        Raises:
            ProgramError: nothing defines the predicate. BudgetExceeded: the answer is unknown.
        """
        try:
            if statement in self._true:
                return True
        except TypeError:  # not hashable, so no statement: `_asked` says so
            pass
        return self._asked(statement)

    def _asked(self, statement: Statement) -> bool:
        """What the index of true statements does not know."""
        model = self._cached or self._model
        if self._index_in is not None:
            self._index_in -= 1
            if self._index_in < 0:
                self._index(model)
        if isinstance(statement, str):
            statement = self._statement(statement)
        relation = model.relations.get((statement[0], len(statement) - 1))
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
        return next(self.instances(atom), None) is not None

    def _index(self, model: Model) -> None:
        """One set of every stored statement that holds, where there are not too many: the fast way to a yes."""
        self._index_in = None
        if sum(map(len, model.relations.values())) <= MOST_INDEXED:
            stored = model.relations.items()
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

    def _answers(
        self,
        alternatives: tuple[tuple[Literal, ...], ...],
        limit: int | None,
        timeout: float | None,
        budget: int,
        cancelled: Callable[[], bool] | None,
    ) -> Iterator[dict[str, Term]]:
        seen: set[Row] = set()
        solver = self.solver(budget)
        solver.deadline = None if timeout is None else time.monotonic() + timeout
        solver.cancelled = cancelled
        for body in alternatives:
            names = [v for v in dict.fromkeys(v for x in body for v in x.variables()) if not v.name.startswith("_")]
            for solution in solver.solve(body):
                row = tuple(substitute(name, solution) for name in names)
                if row not in seen:
                    if limit is not None and len(seen) >= limit:
                        return
                    seen.add(row)
                    yield {name.name: value for name, value in zip(names, row)}

    def instances(self, statement: Statement) -> Iterator[Compound]:
        """Every instance of one atom that holds, lazily, each once; a part that may be anything stays a variable."""
        atom = self._statement(statement)
        self.check_known(atom.indicator)
        seen: set[Compound] = set()
        for solution in self.solver().solve([Literal(atom)]):
            instance: Compound = substitute(atom, solution)
            if instance not in seen:
                seen.add(instance)
                yield instance

    def rows(self, name: str, arity: int) -> Iterator[Row]:
        """The rows of a predicate as tuples of constants; none when it is not defined."""
        if (name, arity) in self._model.program.clauses:
            relation = self.stored((name, arity))
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

    def why_not(self, statement: Statement, history: History = _EMPTY) -> Refusal | None:
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

    def verify(self, statement: Statement, history: History = _EMPTY) -> Verdict:
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

    def repair(self, statement: Statement, history: History = _EMPTY, limit: int = 3) -> list[Repair]:
        """The smallest changes of base facts that make the statement valid; none for one that is, or beyond mending."""
        return repairs(self, self._statement(statement), history, limit)

    def broken(self) -> Sequence[Violation]:
        """The constraints that the facts alone break."""
        return self._model.constraints.always

    def changed(self, repair: Repair) -> KnowledgeBase:
        """A copy of the knowledge base with facts added and removed; this one stays as it is."""
        return self.assume(*sorted(repair.add, key=repr), without=repair.remove)

    # --- what if, and change ---------------------------------------------------------------------------------------

    def assume(self, *facts: Statement, without: Iterable[Statement] = ()) -> KnowledgeBase:
        """The knowledge base as it would be with some facts and without others; this one stays as it is.

        It is an overlay: only what follows from the assumption is worked out, and it is dropped with the object.
        """
        base = KnowledgeBase()
        base._clauses, base._dynamic = dict(self._clauses), set(self._dynamic) | set(self._model.program.clauses)
        base._bulk, base._statements = {i: dict(rows) for i, rows in self._bulk.items()}, dict(self._statements)
        base._cached = self._model.layer(base._computed)
        for fact in without:
            base.retract(fact)
        for fact in facts:
            base.assert_(fact)
        return base

    def assert_(self, fact: Statement) -> bool:
        """Add a fact and bring what follows from it in step; False when it was given already.

        Raises:
            ProgramError: the fact has a variable, or its predicate is the system's.
        """
        return self._change(fact, add=True)

    def retract(self, fact: Statement) -> bool:
        """Take a given fact back, with all that followed from it alone; False when it was not given."""
        return self._change(fact, add=False)

    def _change(self, fact: Statement, *, add: bool) -> bool:
        atom = self._statement(fact)
        if not is_ground(atom):
            raise ProgramError(f"{term_text(as_term(atom))} has a variable; only ground facts can be changed")
        model, clause = self._model, Clause(atom)
        kept = model.keeps(atom.indicator)
        bulk = self._bulk.get(atom.indicator, {})
        if add and (clause in self._clauses or atom.args in bulk):
            return False
        if add:
            self._clauses[clause] = None
        elif self._clauses.pop(clause, _MISSING) is _MISSING and bulk.pop(atom.args, _MISSING) is _MISSING:
            return False
        if kept:
            self._true = set()
            self._index_in = MOST_INDEXED  # by then the questions have cost as much as indexing anew
            return model.change(atom.indicator, atom.args, clause if add else None, add=add)
        self._dynamic |= {atom.indicator}
        self._forget()
        return True

    def facts(self, name: str, rows: Iterable[Row]) -> None:
        """Load many facts of one predicate: ``kb.facts("edge", [("a", "b"), ("b", "c")])``; rows of constants.

        Raises:
            ProgramError: rows of different lengths, or with a variable in them.
        """
        loaded = list(map(tuple, rows))
        arities = set(map(len, loaded))
        if len(arities) > 1:
            raise ProgramError(f"the rows of {name} have {' and '.join(map(str, sorted(arities)))} columns; pick one")
        if any(type(value) is Variable for row in loaded for value in row):
            raise ProgramError(f"a row of {name} has a variable; only constants can be loaded")
        if arities:
            self._bulk.setdefault((name, arities.pop()), {}).update(dict.fromkeys(loaded))
            self._forget()

    # --- the parts below -------------------------------------------------------------------------------------------

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

    def clauses_of(self, indicator: Indicator) -> Sequence[Clause]:
        """The facts and rules of one predicate; none when it is not defined."""
        model = self._model
        if not model.keeps(indicator):
            return model.program.clauses.get(indicator, ())
        facts = (clause or Clause(Compound((indicator[0], *row))) for row, clause in model.given[indicator].items())
        return (*facts, *model.program.rules[indicator])

    def defines(self, name: str, arity: int) -> bool:
        """Whether a predicate has clauses here or is declared dynamic."""
        return (name, arity) in self._model.program.clauses

    def check_known(self, indicator: Indicator) -> None:
        """Refuse a predicate nobody defines.

        Raises:
            ProgramError: with what may have been meant.
        """
        if indicator not in SYSTEM and indicator not in self._model.program.clauses:
            raise ProgramError(undefined_sentence(indicator, self._model.program.clauses))

    def stored(self, indicator: Indicator) -> Relation | None:
        """The relation of a predicate whose rows are all listed; None for one that is answered top-down."""
        return (self._cached or self._model).relations.get(indicator)

    def solver(self, budget: int = DEFAULT_BUDGET, history: History = _EMPTY) -> Solver:
        """A fresh search over everything that holds, after what happened earlier."""
        model = self._model
        return Solver(with_history(model.relations, history), model.program.clauses, self._computed, budget)

    @property
    def _computed(self) -> Mapping[Indicator, Computed]:
        return {("valid", 1): self._valid, ("never", 1): self._broken}

    def _forget(self) -> None:
        """Everything has to be worked out anew."""
        self._cached, self._true, self._index_in = None, set(), 0

    @property
    def _model(self) -> Model:
        if self._cached is None:
            self._cached = Model.of(self._clauses, self._dynamic, self._bulk, self._computed)
        return self._cached

    def _valid(self, atom: Compound) -> Iterator[Compound]:
        """The computed relation valid/1."""
        wanted = atom[1]
        if isinstance(wanted, Variable):
            patterns = [Compound([n, *(Variable(f"V{i}") for i in range(a))]) for n, a in self._statement_predicates()]
        else:
            patterns = [predication(wanted)] if isinstance(wanted, (str, tuple)) else []  # a number is no statement
        for pattern in patterns:
            if pattern.indicator in self._model.program.clauses:
                found = valid_instances(pattern, self.solver(), self._model.constraints)
                yield from (Compound(("valid", as_term(instance))) for instance in found)

    def _broken(self, atom: Compound) -> Iterator[Compound]:
        """The computed relation never/1: the constraints that the facts alone break."""
        for violation in self._model.constraints.always:
            answer = Compound(("never", violation.sentence))
            if unify(atom, answer, {}) is not None:
                yield answer

    def _statement_predicates(self) -> list[Indicator]:
        """The declared action statements; without a declaration, every stored predicate that has a rule."""
        model = self._model
        derived = (i for i, found in model.program.clauses.items() if any(c.body for c in found))
        return list(self._statements) or [i for i in derived if i in model.relations]

    def _undefined(self, indicator: Indicator) -> str:
        """Why a statement whose predicate nobody defines is invalid, with what may have been meant."""
        known = list(self._statements) or list(self._model.program.clauses)
        name, arity = indicator
        if any(name == other for other, _ in known):
            return undefined_sentence(indicator, known)
        close = get_close_matches(name, sorted({other for other, _ in known}), n=1)
        return f"there is no action {name}/{arity} here" + (f"; did you mean {close[0]}?" if close else "")

    def _statement(self, statement: Statement) -> Compound:
        return _statement_of_text(statement) if isinstance(statement, str) else predication(statement)

    def __len__(self) -> int:
        return len(self._clauses)

    def __repr__(self) -> str:
        return f"<KnowledgeBase: {len(self._clauses)} clauses>"


def _dynamic(directive: Directive) -> Indicator:
    """The predicate of a ``:- dynamic(name/arity).`` declaration."""
    term = directive.term
    inner = term[1] if term.indicator == ("dynamic", 1) else None
    if isinstance(inner, Compound) and inner.indicator == ("/", 2):
        name, arity = inner.args
        if isinstance(name, str) and isinstance(arity, int) and arity >= 0:
            return name, arity
    raise ProgramError(f"the only directive is :- dynamic(name/arity), not {term_text(as_term(term))}", directive.place)
