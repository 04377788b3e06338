"""The clauses behind a knowledge base: stated, compiled, changed and printed. What is asked of them is in `kb.base`."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Iterator, Mapping, Sequence
from functools import lru_cache
from typing import Self, TypeAlias

from casper.kb.errors import ProgramError
from casper.kb.program.refusals import undefined_sentence
from casper.kb.reasons.validity import History, valid_instances
from casper.kb.relations.relation import Relation, Row
from casper.kb.store.model import Model
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM, Clause, Directive, Indicator, Sentence
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.terms.unification import is_ground, unify
from casper.kb.text.reader import read_statement, read_text
from casper.kb.text.writer import program_text
from casper.kb.top_down.compiled.cells import variant
from casper.kb.top_down.linking import Computed
from casper.kb.top_down.search import DEFAULT_BUDGET, Search

Statement: TypeAlias = str | tuple[Term, ...]  # text, or a Compound / a tuple that starts with the name
NO_HISTORY: History = ()
MOST_INDEXED = 20_000  # statements up to which all that hold are kept in one set
_MISSING = object()
_statement_of_text = lru_cache(maxsize=4096)(read_statement)


class ClauseStore:
    """Facts, rules and constraints, and the model worked out of them when it is first needed."""

    def __init__(self, clauses: Iterable[Clause] = (), dynamic: Iterable[Indicator] = ()) -> None:
        self._clauses: dict[Clause, None] = dict.fromkeys(clauses)  # in the author's order, each once
        self._bulk: dict[Indicator, dict[Row, None]] = {}
        self._dynamic: set[Indicator] = set(dynamic)
        self._stored: set[Indicator] = set()  # whose rows are to be listed, however many
        self._statements: dict[Indicator, None] = {}
        self._cached: Model | None = None
        self._true: set[Statement] = set()  # stored statements that hold, once they are indexed
        self._validated: dict[Hashable, list[Compound]] = {}  # answers of valid/1, by what was asked
        self._false: set[Statement] = set()  # statements that were asked and do not hold
        self._index_in: int | None = 0  # questions until they are
        self.changes = 0  # how often something was added or taken back: what was asked before may be different now

    # --- authoring -------------------------------------------------------------------------------------------------

    @classmethod
    def from_text(cls, text: str, file: str = "<text>") -> Self:
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
                name, indicator = _declared(sentence)
                (self._dynamic if name == "dynamic" else self._stored).add(indicator)
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
        self._validated = {}

    def compile(self) -> None:
        """Check, stratify and materialise now instead of at the first question.

        Raises:
            ProgramError: see `kb.program.program.analyse`.
        """
        _ = self._model

    @property
    def clauses(self) -> Sequence[Clause]:
        """Every clause, in the author's order, then the facts that were loaded in bulk."""
        loaded = (Clause(Compound((name, *row))) for (name, _), rows in self._bulk.items() for row in rows)
        return (*self._clauses, *loaded)

    def to_text(self) -> str:
        """The clauses as text that reads in as the same model."""
        kinds = (("dynamic", self._dynamic), ("stored", self._stored))
        declared = [Directive(Compound((kind, Compound(("/", *i))))) for kind, found in kinds for i in sorted(found)]
        return program_text([*declared, *self.clauses])

    # --- what if, and change ---------------------------------------------------------------------------------------

    def assume(self, *facts: Statement, without: Iterable[Statement] = ()) -> Self:
        """The knowledge base as it would be with some facts and without others; this one stays as it is.

        It is an overlay: only what follows from the assumption is worked out, and it is dropped with the object.
        """
        base = type(self)()
        base._stored = set(self._stored)
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
        self.changes += 1
        if kept:
            self._true, self._false, self._validated = set(), set(), {}
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

    # --- for those who ask -----------------------------------------------------------------------------------------

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

    @property
    def depends_on_history(self) -> bool:
        """Whether a rule or constraint looks at did/2: otherwise what happened earlier changes no verdict."""
        return self._model.program.looks_back

    def check_known(self, indicator: Indicator) -> None:
        """Refuse a predicate nobody defines.

        Raises:
            ProgramError: with what may have been meant.
        """
        if indicator not in SYSTEM and indicator not in BUILTINS and indicator not in self._model.program.clauses:
            raise ProgramError(undefined_sentence(indicator, self._model.program.clauses))

    def stored(self, indicator: Indicator) -> Relation | None:
        """The relation of a predicate whose rows are all at hand; None for one that is answered top-down for now."""
        return (self._cached or self._model).at_hand.get(indicator)

    def solver(self, budget: int = DEFAULT_BUDGET, history: History = NO_HISTORY) -> Search:
        """A fresh search over everything that holds, after what happened earlier."""
        return self._model.search(history, budget)

    @property
    def _computed(self) -> Mapping[Indicator, Computed]:
        return {("valid", 1): self._valid, ("never", 1): self._broken}

    def _forget(self) -> None:
        """Everything has to be worked out anew."""
        self.changes += 1
        self._cached, self._index_in = None, 0
        self._true, self._false, self._validated = set(), set(), {}

    @property
    def _model(self) -> Model:
        if self._cached is None:
            self._cached = Model.of(self._clauses, self._dynamic, self._bulk, self._computed, self._stored)
        return self._cached

    def _valid(self, atom: Compound) -> Iterator[Compound]:
        """The computed relation valid/1; what was found of it in full is kept until something changes."""
        key = variant(atom.args)
        known = self._validated.get(key)
        if known is not None:
            yield from known
            return
        changes, found = self.changes, list[Compound]()
        for answer in self._valid_anew(atom[1]):
            if len(found) <= MOST_INDEXED:
                found.append(answer)
            yield answer
        if changes == self.changes and len(found) + len(self._validated) <= MOST_INDEXED:
            self._validated[key] = found

    def _valid_anew(self, wanted: Term) -> Iterator[Compound]:
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
        return list(self._statements) or [i for i in derived if model.keeps(i)]

    def _statement(self, statement: Statement) -> Compound:
        return _statement_of_text(statement) if isinstance(statement, str) else predication(statement)

    def __len__(self) -> int:
        return len(self._clauses)

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self._clauses)} clauses>"


def _declared(directive: Directive) -> tuple[str, Indicator]:
    """What a ``:- dynamic(name/arity).`` or ``:- stored(name/arity).`` declares, and of which predicate."""
    term = directive.term
    inner = term[1] if term.indicator in (("dynamic", 1), ("stored", 1)) else None
    if isinstance(inner, Compound) and inner.indicator == ("/", 2):
        name, arity = inner.args
        if isinstance(name, str) and isinstance(arity, int) and arity >= 0:
            return term.functor, (name, arity)
    raise ProgramError(f"the only directive is :- dynamic(name/arity), not {term_text(as_term(term))}", directive.place)
