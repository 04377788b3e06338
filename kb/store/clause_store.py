"""The clauses behind a knowledge base: stated, compiled, changed and printed. What is asked of them is in `kb.base`."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import replace
from functools import lru_cache, wraps
from threading import RLock
from typing import Any, Concatenate, ParamSpec, Self, TypeAlias, TypeVar
from weakref import ref

from casper.kb.errors import ProgramError, Undefined
from casper.kb.program.declarations import Moded, declaration, tabled
from casper.kb.program.refusals import undefined_sentence
from casper.kb.reasons.validity import History, valid_instances
from casper.kb.relations.relation import Relation, Row
from casper.kb.store.loading import loading
from casper.kb.store.model import Model
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM, Clause, Directive, Indicator, Sentence, is_auxiliary
from casper.kb.terms.origins import FactBlock, Origin, clause_behind
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.terms.unification import is_ground, unify
from casper.kb.text.lines import text_of
from casper.kb.text.reader import read_blocks, read_statement, read_text
from casper.kb.text.writer import MOST_SHOWN, indicators_text, program_lines, program_text
from casper.kb.top_down.answering import Answering
from casper.kb.top_down.compiled.cells import variant
from casper.kb.top_down.linking import Computed
from casper.kb.top_down.solve import DEFAULT_BUDGET

Statement: TypeAlias = str | tuple[Term, ...]  # text, or a Compound / a tuple that starts with the name
NO_HISTORY: History = ()
MOST_INDEXED = 20_000  # statements up to which all that hold are kept in one set
_statement_of_text = lru_cache(maxsize=4096)(read_statement)
S = TypeVar("S", bound="ClauseStore")
P = ParamSpec("P")
R = TypeVar("R")


def of_one_moment(question: Callable[Concatenate[S, P], R]) -> Callable[Concatenate[S, P], R]:
    """A question that is answered from a snapshot: lazily too, and whatever other threads change meanwhile."""

    @wraps(question)
    def asked(self: S, /, *args: P.args, **kwargs: P.kwargs) -> R:
        return question(self.snapshot(), *args, **kwargs)

    return asked


class ClauseStore:
    """Facts, rules and constraints, and the model worked out of them when it is first needed.

    Several threads may ask while others change it. A change holds ``lock``; a question that takes longer than one look
    holds a `snapshot`, and what a snapshot holds is never changed: the next change is made in a layer over it.
    """

    def __init__(self, clauses: Iterable[Clause] = (), dynamic: Iterable[Indicator] = ()) -> None:
        self._clauses: dict[Clause, None] = dict.fromkeys(clauses)  # in the author's order, each once
        self._bulk: dict[Indicator, dict[Row, Origin]] = {}
        self._dynamic: set[Indicator] = set(dynamic)
        self._least: dict[Indicator, Moded] = {}
        self._stored: set[Indicator] = set()  # whose rows are to be listed, however many
        self._statements: dict[Indicator, None] = {}
        self._cached: Model | None = None
        self._true: set[Statement] = set()  # stored statements that hold, once they are indexed
        self._false: set[Statement] = set()  # statements that were asked and do not hold
        self._validated: dict[Hashable, list[Compound]] = {}  # answers of valid/1, by what was asked
        self._index_in: int | None = 0  # questions until they are
        self.changes = 0  # how often something was added or taken back: what was asked before may be different now
        self.lock = RLock()  # held while anything changes, and while something is looked up that may
        self._begun = self._ended = 0  # changes: one is under way when these differ
        self._view: Callable[[], Self | None] = _nobody  # the snapshot of how it is now, while somebody holds it
        self._shared: set[Indicator] = set()  # predicates whose bulk rows a snapshot has, too
        self._below: ClauseStore | None = None  # the snapshot that an assumption is laid over

    # --- authoring -------------------------------------------------------------------------------------------------

    @classmethod
    def from_text(cls, text: str, file: str = "<text>") -> Self:
        """A knowledge base from the language's text.

        Raises:
            ReadError, ProgramError: with the place of the first mistake.
        """
        base = cls()
        with loading():
            sentences, blocks = read_blocks(text, file)
            base.add(sentences)
            for block in blocks:
                base._load(block.indicator, block.rows, block)
            base.compile()
        return base

    def add(self, sentences: Iterable[Sentence]) -> None:
        """Add clauses and declarations (``:- dynamic``, ``table``, ``discontiguous``).

        Productions are the plan library's, not ours.

        Raises:
            ProgramError: a directive nobody knows, or a production.
        """
        with self._changing():
            self._forget()
            for sentence in sentences:
                if isinstance(sentence, Clause):
                    self._clauses.setdefault(sentence)
                elif isinstance(sentence, Directive):
                    declared = declaration(sentence)
                    self._dynamic.update(declared.dynamic)
                    self._least.update(declared.least)
                    self._stored.update(declared.stored)
                else:
                    mistake = "a plan (-->) belongs in a plan library, not in a knowledge base"
                    raise ProgramError(mistake, sentence.place)

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
        with self._changing():
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
        with self.lock:
            loaded = (_stated(i, row, behind) for i, rows in self._bulk.items() for row, behind in rows.items())
            return (*self._clauses, *loaded)

    def to_text(self) -> str:
        """The clauses as text that reads in as the same model."""
        kinds = (("dynamic", self._dynamic), ("stored", self._stored))
        declared = [Directive(Compound((kind, Compound(("/", *i))))) for kind, found in kinds for i in sorted(found)]
        declared += [tabled(indicator, moded) for indicator, moded in sorted(self._least.items())]
        return program_text([*declared, *self.clauses])

    # --- what if, and change ---------------------------------------------------------------------------------------

    @of_one_moment
    def assume(self, *facts: Statement, without: Iterable[Statement] = ()) -> Self:
        """The knowledge base as it would be with some facts and without others; this one stays as it is.

        It is an overlay: only what follows from the assumption is worked out, and it is dropped with the object. What
        changes here later does not change it.
        """
        base = type(self)()
        base._below = self
        base._clauses, base._dynamic = dict(self._clauses), set(self._dynamic) | self._own_predicates()
        base._least, base._stored = dict(self._least), set(self._stored)
        base._bulk, base._shared, base._statements = dict(self._bulk), set(self._bulk), dict(self._statements)
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
        clause = Clause(atom)
        with self.lock:
            given = clause in self._clauses or atom.args in self._bulk.get(atom.indicator, ())
            kept = self._model.keeps(atom.indicator)
            if given == add:
                return False
            with self._changing():
                if add:
                    self._clauses[clause] = None
                else:
                    self._clauses.pop(clause, None)
                    self._loaded(atom.indicator).pop(atom.args, None)
                return self._follow(atom, clause if add else None, kept)

    def _follow(self, atom: Compound, clause: Clause | None, kept: bool) -> bool:
        """Bring the model in step with a fact that came (with its clause) or went."""
        if not kept:
            self._dynamic |= {atom.indicator}
            self._forget()
            return True
        self.changes += 1
        self._true, self._false, self._validated = set(), set(), {}
        self._index_in = MOST_INDEXED  # by then the questions have cost as much as indexing anew
        try:
            return self._model.change(atom.indicator, atom.args, clause, add=clause is not None)
        except BaseException:  # the rows are then in no defined state
            self._forget()
            raise

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
            self._load((name, arities.pop()), loaded, None)

    def _load(self, indicator: Indicator, rows: Iterable[Row], origin: Origin) -> None:
        with self._changing():
            new: dict[Row, Origin] = dict.fromkeys(rows, origin)
            new.update(self._bulk.get(indicator, {}))
            self._bulk[indicator] = new
            self._shared.discard(indicator)
            self._forget()

    # --- other threads, other processes ----------------------------------------------------------------------------

    def snapshot(self) -> Self:
        """The knowledge base as it is now, for as long as it is held; it costs microseconds, and cannot be changed.

        Several questions that must see one state are asked of one snapshot; kanren goals, too. Every single question
        sees one state anyway.
        """
        if self._view is _frozen:
            return self
        with self.lock:
            view = self._view()
            if view is None:
                view = object.__new__(type(self))
                ClauseStore.__init__(view)
                view._clauses, view._bulk, view._dynamic = self._clauses, self._bulk, self._dynamic
                view._least, view._stored = self._least, self._stored
                view._false, view._validated = self._false, self._validated
                view._statements, view._cached, view.changes = self._statements, self._model, self.changes
                view._true, view._index_in, view._view = self._true, None, _frozen
                self._view = ref(view)
            return view

    @contextmanager
    def _changing(self) -> Iterator[None]:
        """While a change is made: nobody else makes one, and nothing that a snapshot holds is in its way.

        Raises:
            ProgramError: this is a snapshot.
        """
        if self._view is _frozen:
            raise ProgramError("a snapshot stays as it is: change the knowledge base, or ask assume(…) what if")
        with self.lock:
            self._begun += 1
            try:
                if self._view() is not None:
                    self._part()
                yield
            finally:
                self._ended += 1

    def _part(self) -> None:
        """Leave everything to the snapshot that has it, and go on with copies and a layer over the model."""
        self._view = _nobody
        self._clauses, self._dynamic = dict(self._clauses), set(self._dynamic)
        self._least, self._stored = dict(self._least), set(self._stored)
        self._bulk, self._shared, self._statements = dict(self._bulk), set(self._bulk), dict(self._statements)
        if self._cached is not None:
            self._cached = self._cached.apart(self._computed)

    def _loaded(self, indicator: Indicator) -> dict[Row, Origin]:
        """The bulk rows of a predicate, to be changed."""
        if indicator in self._shared:
            self._shared.discard(indicator)
            self._bulk[indicator] = dict(self._bulk[indicator])
        return self._bulk.setdefault(indicator, {})

    def __reduce__(self) -> tuple[Any, ...]:
        """By what was stated: what follows is worked out anew where it arrives. A snapshot arrives as a base."""
        with self.lock:
            bulk = {i: {row: _kept(i, row, origin) for row, origin in rows.items()} for i, rows in self._bulk.items()}
            stated = tuple(self._clauses), bulk, tuple(self._dynamic), tuple(self._statements)
            return _restated, (type(self), *stated, tuple(self._least.items()), tuple(self._stored))

    def __deepcopy__(self, memo: dict[int, Any]) -> Self:
        """A base that goes its own way; clauses and rows never change, so both have the same."""
        function, arguments = self.__reduce__()
        copy: Self = function(*arguments)
        return copy

    # --- for those who ask -----------------------------------------------------------------------------------------

    @of_one_moment
    def clauses_of(self, indicator: Indicator) -> Sequence[Clause]:
        """The facts and rules of one predicate; none when it is not defined."""
        model = self._model
        if not model.keeps(indicator):
            return model.program.clauses.get(indicator, ())
        facts = (_stated(indicator, row, behind) for row, behind in model.given[indicator].items())
        return (*facts, *model.program.rules[indicator])

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

    @of_one_moment
    def solver(self, budget: int = DEFAULT_BUDGET, history: History = NO_HISTORY) -> Answering:
        """A fresh search over everything that holds now, after what happened earlier."""
        return replace(self._model.search(history, budget), computed=self._computed)

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
        model = self._cached
        if model is None:
            with self.lock:
                stated = self._clauses, self._dynamic, self._bulk
                model = self._cached or Model.of(*stated, self._computed, self._least, self._stored)
                self._cached = model
        return model

    def _valid(self, atom: Compound) -> Iterator[Compound]:
        """The computed relation valid/1; what was found of it in full is kept until something changes."""
        key, kept = variant(atom.args), self._validated
        known = kept.get(key)
        if known is not None:
            yield from known
            return
        found = list[Compound]()
        for answer in self._valid_anew(atom[1]):
            if len(found) <= MOST_INDEXED:
                found.append(answer)
            yield answer
        if kept is self._validated and len(found) + len(kept) <= MOST_INDEXED:
            kept[key] = found

    def _valid_anew(self, wanted: Term) -> Iterator[Compound]:
        if isinstance(wanted, Variable):
            patterns = [Compound([n, *(Variable(f"V{i}") for i in range(a))]) for n, a in self._statement_predicates()]
        else:
            patterns = [predication(wanted)] if isinstance(wanted, (str, tuple)) else []  # a number is no statement
        doubt: Undefined | None = None
        for pattern in patterns:
            if pattern.indicator in self._model.program.clauses:
                constraints = self._model.constraints  # which may list what follows: before the search begins
                found = valid_instances(pattern, self.solver(), constraints)
                try:
                    yield from (Compound(("valid", as_term(instance))) for instance in found)
                except Undefined as mistake:
                    doubt = doubt or mistake
        if doubt is not None:
            raise doubt

    def _broken(self, atom: Compound) -> Iterator[Compound]:
        """The computed relation never/1: the constraints that the facts alone break."""
        doubts: dict[str, str] = {}
        for violation in self._model.constraints.always:
            answer = Compound(("never", violation.sentence))
            if unify(atom, answer, {}) is not None:
                if not violation.doubt:
                    doubts.pop(violation.sentence, None)
                    yield answer
                else:
                    doubts.setdefault(violation.sentence, str(violation))
        if doubts:
            raise Undefined(next(iter(doubts.values())))

    def _own_predicates(self) -> set[Indicator]:
        """The predicates that are defined, without those that only stand for goals inside clauses."""
        return {i for i in self._model.program.clauses if not is_auxiliary(i)}

    def _statement_predicates(self) -> list[Indicator]:
        """The declared action statements; without a declaration, every stored predicate that has a rule."""
        model = self._model
        own = self._own_predicates()
        derived = (i for i, found in model.program.clauses.items() if i in own and any(c.body for c in found))
        return list(self._statements) or [i for i in derived if model.keeps(i)]

    def _statement(self, statement: Statement) -> Compound:
        return _statement_of_text(statement) if isinstance(statement, str) else predication(statement)

    def __len__(self) -> int:
        return len(self._clauses) + sum(map(len, self._bulk.values()))

    def __str__(self) -> str:
        """The clauses; of many, what predicates there are."""
        if len(self) <= MOST_SHOWN:
            return text_of(program_lines(self.clauses))
        indicators = dict.fromkeys([*(clause.head.indicator for clause in self._clauses), *self._bulk])
        return f"{len(self)} clauses of {len(indicators)} predicates: {indicators_text(indicators)}"

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)} clauses>"


def _nobody() -> None:
    """No snapshot is held."""


def _frozen() -> None:
    """This is a snapshot itself."""


def _restated(
    kind: type[S],
    clauses: Iterable[Clause],
    bulk: Mapping[Indicator, Mapping[Row, Origin]],
    dynamic: Iterable[Indicator],
    statements: Iterable[Indicator],
    least: Iterable[tuple[Indicator, Moded]] = (),
    stored: Iterable[Indicator] = (),
) -> S:
    """A knowledge base of what was stated."""
    base = kind()
    base._least, base._stored = dict(least), set(stored)
    base._clauses, base._dynamic, base._statements = dict.fromkeys(clauses), set(dynamic), dict.fromkeys(statements)
    base._bulk = {indicator: dict(rows) for indicator, rows in bulk.items()}
    return base


def _kept(indicator: Indicator, row: Row, origin: Origin) -> Origin:
    """Where a row comes from, as it travels: a clause with its place instead of the text that it stands in."""
    return _stated(indicator, row, origin) if isinstance(origin, FactBlock) else origin


def _stated(indicator: Indicator, row: Row, origin: Origin) -> Clause:
    """The fact that states a row."""
    return clause_behind(Compound((indicator[0], *row)), origin)
