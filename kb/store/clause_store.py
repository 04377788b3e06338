"""The clauses behind a knowledge base: stated, compiled, changed and printed. What is asked of them is in `kb.base`."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from functools import lru_cache
from typing import Any, Self, TypeVar

from casper.kb.errors import ProgramError
from casper.kb.reasons.says import SAYS, Words, words_of
from casper.kb.relations.relation import Row
from casper.kb.store.computed import own_predicates
from casper.kb.store.known import MOST_INDEXED, Statement
from casper.kb.store.loading import loading
from casper.kb.store.stated import Stated, fact_of
from casper.kb.store.versioned import Versioned, of_one_moment
from casper.kb.terms.clauses import Clause, Indicator, Sentence
from casper.kb.terms.origins import FactBlock, Origin
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term, predication
from casper.kb.terms.unification import is_ground
from casper.kb.text.lines import text_of
from casper.kb.text.reader import read_blocks, read_statement, read_text
from casper.kb.text.writer import MOST_SHOWN, indicators_text, program_lines, program_text

_statement_of_text = lru_cache(maxsize=4096)(read_statement)
S = TypeVar("S", bound="ClauseStore")


class ClauseStore(Versioned):
    """Facts, rules and constraints: how they come in, change, and are printed."""

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
            base.add_blocks(blocks)
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
                self._stated.add(sentence)

    def add_blocks(self, blocks: Iterable[FactBlock]) -> None:
        """Add runs of facts as a large text has them (`kb.text.reader.read_blocks`)."""
        for block in blocks:
            self._load(block.indicator, block.rows, block)

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
            self._stated.statements.update(dict.fromkeys(statements))
            self._validated = {}

    @property
    def language(self) -> str:
        """The language in which reasons are told, as far as ``say/3`` has sentences in it; empty: as ``say/2`` has."""
        return self._stated.language

    @language.setter
    def language(self, language: str) -> None:
        with self._changing():
            self._stated.language = language
            self.changes += 1  # reasons that were kept are told anew

    @property
    def words(self) -> Words:
        """The author's sentences, in the language of the base."""
        kept, language = self._worded, self.language
        found = kept.get(language)
        if found is None:
            clauses = [clause for indicator in SAYS for clause in self.clauses_of(indicator)]
            found = kept[language] = words_of(clauses, language)
        return found

    @property
    def declared(self) -> Sequence[Indicator]:
        """The predicates that are action statements, in the order in which they were named."""
        return tuple(self._stated.statements)

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
            return self._stated.everything()

    def unmentioned(self, names: Iterable[str]) -> set[str]:
        """Those of the names that stand nowhere in what was stated, as an argument."""
        missing = set(names)
        with self.lock:
            for name in self._stated.names():
                missing.discard(name)
                if not missing:
                    break
        return missing

    def names(self, most: int) -> set[str]:
        """The constants that are names; of more than ``most`` some of them."""
        found: set[str] = set()
        with self.lock:
            for name in self._stated.names():
                found.add(name)
                if len(found) >= most:
                    break
        return found

    def to_text(self) -> str:
        """The clauses as text that reads in as the same model."""
        with self.lock:
            return program_text(list(self._stated.sentences()))

    # --- what if, and change ---------------------------------------------------------------------------------------

    @of_one_moment
    def assume(self, *facts: Statement, without: Iterable[Statement] = ()) -> Self:
        """The knowledge base as it would be with some facts and without others; this one stays as it is.

        It is an overlay: only what follows from the assumption is worked out, and it is dropped with the object. What
        changes here later does not change it.
        """
        base = type(self)()
        base._below = self
        base._stated = self._stated.copied()
        base._stated.dynamic |= own_predicates(self._model)
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
            kept = self._model.keeps(atom.indicator)
            if self._stated.states(clause) == add:
                return False
            with self._changing():
                if add:
                    self._stated.clauses[clause] = None
                else:
                    self._stated.take_back(clause)
                return self._follow(atom, clause if add else None, kept)

    def _follow(self, atom: Compound, clause: Clause | None, kept: bool) -> bool:
        """Bring the model in step with a fact that came (with its clause) or went."""
        if not kept:
            self._stated.dynamic.add(atom.indicator)
            self._forget()
            return True
        self.changes += 1
        self._forget_answers()
        if atom.indicator in SAYS:
            self._worded = {}
        self._index_in = MOST_INDEXED  # by then the questions have cost as much as indexing anew
        try:
            return self._model.change(atom.indicator, atom.args, clause, add=clause is not None)
        except BaseException:  # the rows are then in no defined state
            self._forget()
            raise

    def facts(self, name: str, rows: Iterable[Row]) -> None:
        """Load many facts of one predicate: ``kb.facts("edge", [("a", "b"), ("b", "c")])``; rows of ground terms.

        Raises:
            ProgramError: rows of different lengths.
        """
        loaded = list(map(tuple, rows))
        arities = set(map(len, loaded))
        if len(arities) > 1:
            raise ProgramError(f"the rows of {name} have {' and '.join(map(str, sorted(arities)))} columns; pick one")
        if arities:
            self._load((name, arities.pop()), loaded, None)

    def _load(self, indicator: Indicator, rows: Iterable[Row], origin: Origin) -> None:
        with self._changing():
            self._stated.load(indicator, rows, origin)
            self._forget()

    # --- other threads, other processes ----------------------------------------------------------------------------

    def __reduce__(self) -> tuple[Any, ...]:
        """By what was stated: what follows is worked out anew where it arrives. A snapshot arrives as a base."""
        with self.lock:
            return _restated, (type(self), self._stated.packed())

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
        facts = (fact_of(indicator, row, behind) for row, behind in model.given[indicator].items())
        return (*facts, *model.program.rules[indicator])

    @staticmethod
    def _statement(statement: Statement) -> Compound:
        return _statement_of_text(statement) if isinstance(statement, str) else predication(statement)

    def __len__(self) -> int:
        return len(self._stated)

    def __str__(self) -> str:
        """The clauses; of many, what predicates there are."""
        if len(self) <= MOST_SHOWN:
            return text_of(program_lines(self.clauses))
        indicators = self._stated.indicators()
        return f"{len(self)} clauses of {len(indicators)} predicates: {indicators_text(indicators)}"

    def __repr__(self) -> str:
        return f"<{type(self).__name__}: {len(self)} clauses>"


def _restated(kind: type[S], stated: Stated) -> S:
    """A knowledge base of what was stated."""
    base = kind()
    base._stated = stated.copied()
    base._stated.shared.clear()  # its bulk rows travelled with it
    return base
