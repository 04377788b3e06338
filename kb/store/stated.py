"""What authors and programs stated: clauses, facts in bulk, declarations. Nothing here is worked out."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.kb.errors import ProgramError
from casper.kb.program.declarations import Moded, declaration, tabled
from casper.kb.reasons.says import is_say
from casper.kb.relations.relation import Row
from casper.kb.terms.clauses import Clause, Directive, Indicator, Sentence
from casper.kb.terms.origins import FactBlock, Origin, clause_behind
from casper.kb.terms.terms import Compound, Term

Bulk: TypeAlias = dict[Indicator, dict[Row, Origin]]


@dataclass(slots=True)
class Stated:
    """The clauses in the author's order, each once, and what was declared of predicates.

    ``stored`` are the predicates whose rows are to be listed, however many; ``shared`` those whose bulk rows another
    one has, too: they are copied before they are changed.
    """

    clauses: dict[Clause, None] = field(default_factory=dict)
    dynamic: set[Indicator] = field(default_factory=set)
    bulk: Bulk = field(default_factory=dict)
    least: dict[Indicator, Moded] = field(default_factory=dict)
    stored: set[Indicator] = field(default_factory=set)
    statements: dict[Indicator, None] = field(default_factory=dict)
    shared: set[Indicator] = field(default_factory=set)
    language: str = ""  # in which reasons are told, where somebody worded them
    offered: set[Indicator] = field(default_factory=set)  # what others answer, where it is asked

    def copied(self) -> Stated:
        """The same, to go its own way."""
        own = dict(self.clauses), set(self.dynamic), dict(self.bulk), dict(self.least), set(self.stored)
        return Stated(*own, dict(self.statements), set(self.bulk), self.language, set(self.offered))

    def add(self, sentence: Sentence) -> None:
        """Add a clause or a declaration.

        Raises:
            ProgramError: a directive nobody knows, or a production.
        """
        if isinstance(sentence, Clause):
            self.clauses.setdefault(sentence)
        elif isinstance(sentence, Directive):
            declared = declaration(sentence)
            self.dynamic.update(declared.dynamic)
            self.least.update(declared.least)
            self.stored.update(declared.stored)
        else:
            raise ProgramError("a plan (-->) belongs in a plan library, not in a knowledge base", sentence.place)

    def load(self, indicator: Indicator, rows: Iterable[Row], origin: Origin) -> None:
        """Add many facts of one predicate; what stands behind a row that is there already stays."""
        new: dict[Row, Origin] = dict.fromkeys(rows, origin)
        new.update(self.bulk.get(indicator, {}))
        self.bulk[indicator] = new
        self.shared.discard(indicator)

    def states(self, clause: Clause) -> bool:
        """Whether a fact was stated, by itself or in bulk."""
        return clause in self.clauses or clause.head.args in self.bulk.get(clause.head.indicator, ())

    def take_back(self, clause: Clause) -> None:
        """Remove a fact, however it was stated; its predicate stays defined."""
        self.clauses.pop(clause, None)
        indicator = clause.head.indicator
        if indicator in self.shared:
            self.shared.discard(indicator)
            self.bulk[indicator] = dict(self.bulk[indicator])
        self.bulk.setdefault(indicator, {}).pop(clause.head.args, None)

    def everything(self) -> tuple[Clause, ...]:
        """Every clause, in the author's order, then the facts that were loaded in bulk."""
        loaded = (fact_of(i, row, behind) for i, rows in self.bulk.items() for row, behind in rows.items())
        return (*self.clauses, *loaded)

    def names(self) -> Iterator[str]:
        """Every constant that is a name, wherever one stands as an argument, as often as it does."""
        waiting: list[Term] = []
        for clause in self.clauses:
            if clause.is_constraint or is_say(clause):  # which have sentences
                continue
            for atom in (clause.head, *(literal.atom for literal in clause.body)):
                waiting.extend(atom.args)
            while waiting:
                term = waiting.pop()
                if isinstance(term, str):
                    yield term
                elif isinstance(term, Compound):
                    waiting.extend(term.args)
        for rows in self.bulk.values():
            for row in rows:
                yield from (value for value in row if isinstance(value, str))

    def sentences(self) -> Iterator[Sentence]:
        """Everything as a text has it: what is declared, then the clauses."""
        for kind, found in (("dynamic", self.dynamic), ("stored", self.stored)):
            for indicator in sorted(found):
                yield Directive(Compound((kind, Compound(("/", *indicator)))))
        for indicator, moded in sorted(self.least.items()):
            yield tabled(indicator, moded)
        yield from self.everything()

    def indicators(self) -> list[Indicator]:
        """The predicates that something is stated of, in the author's order."""
        return list(dict.fromkeys([*(clause.head.indicator for clause in self.clauses), *self.bulk]))

    def packed(self) -> Stated:
        """The same as it travels to other processes: rows with their clauses instead of the text they stand in."""
        bulk: Bulk = {i: {r: _kept(i, r, origin) for r, origin in rows.items()} for i, rows in self.bulk.items()}
        kept = self.clauses, self.dynamic, bulk, self.least, self.stored, self.statements
        return Stated(*kept, language=self.language, offered=self.offered)

    def __len__(self) -> int:
        return len(self.clauses) + sum(map(len, self.bulk.values()))


def fact_of(indicator: Indicator, row: Row, origin: Origin) -> Clause:
    """The fact that states a row."""
    return clause_behind(Compound((indicator[0], *row)), origin)


def _kept(indicator: Indicator, row: Row, origin: Origin) -> Origin:
    return fact_of(indicator, row, origin) if isinstance(origin, FactBlock) else origin
