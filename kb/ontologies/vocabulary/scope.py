"""What the translation of one axiom works in: names, kinds, fresh variables, and whether things may be equal."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, field
from itertools import chain, count

from casper.kb.ontologies.citing import cited
from casper.kb.ontologies.expressions import (
    NOTHING,
    OWL,
    THING,
    Anonymous,
    Expression,
    Iri,
    Kind,
    Ontology,
    Part,
    Unknown,
    Value,
)
from casper.kb.ontologies.vocabulary.refusals import Beyond
from casper.kb.ontologies.vocabulary.values import term_of
from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound, Term, Variable

LETTERS = ("X", "Y", "Z", "U", "V", "W")


@dataclass
class Vocabulary:
    """What holds for the whole ontology.

    ``equality`` says whether two names may stand for one thing; ``ranges`` are the stated ranges of each property,
    ``spelt`` the datatypes of the values that are stated of it, ``datatypes`` the definitions of named ones.
    """

    ontology: Ontology
    names: Mapping[str, str]
    equality: bool = False
    ranges: dict[str, list[Part]] = field(default_factory=dict)
    spelt: dict[str, set[str]] = field(default_factory=dict)
    datatypes: dict[str, Part] = field(default_factory=dict)
    groups: dict[tuple[Part, ...], int] = field(default_factory=dict)

    def is_data(self, on: Part) -> bool:
        """Whether a property has data values."""
        return isinstance(on, Iri) and self.ontology.is_a(on.text, Kind.DATA)

    def ranges_of(self, on: Part) -> list[Part]:
        """The stated ranges of a property."""
        return self.ranges.get(on.text, []) if isinstance(on, Iri) else []

    def group(self, members: tuple[Part, ...]) -> int:
        """A number for things that an axiom tells apart: the same whenever the axiom is translated."""
        return self.groups.setdefault(members, len(self.groups) + 1)

    def name(self, iri: Iri) -> str:
        """The predicate or individual an IRI is here.

        Raises:
            Beyond: it is a word of OWL's own that rules have no counterpart for.
        """
        if iri == THING:
            return "thing"
        if iri.text not in self.names:
            raise Beyond(f"{cited(iri)} of OWL itself has no counterpart in rules")
        return self.names[iri.text]

    def constant(self, part: Part) -> Term:
        """An individual or a value as a term."""
        if isinstance(part, Value):
            return term_of(part, self.names)
        if isinstance(part, Anonymous):
            return f"_:{part.label}"
        if isinstance(part, Iri) and part != NOTHING:
            return self.name(part)
        raise Beyond(f"{cited(part)} is no individual and no value")


class Scope:
    """One axiom under translation."""

    def __init__(self, vocabulary: Vocabulary, sentence: str) -> None:
        self.vocabulary, self.sentence = vocabulary, sentence
        self._unknowns: dict[str, Variable] = {}
        self._names = self._fresh_names()
        self.data: set[Variable] = set()  # variables that stand for data values
        self.notes: list[str] = []  # what the clauses take for granted

    def _fresh_names(self) -> Iterator[str]:
        yield from LETTERS
        yield from (f"{letter}{number}" for number in count(1) for letter in LETTERS)

    def fresh(self, data: bool = False) -> Variable:
        """A variable of its own."""
        taken = {v.name for v in self._unknowns.values()}
        variable = Variable(next(name for name in self._names if name not in taken))
        if data:
            self.data.add(variable)
        return variable

    @property
    def has_unknowns(self) -> bool:
        """Whether the author gave the variables their names."""
        return bool(self._unknowns)

    def term(self, part: Part) -> Term:
        """A variable of a rule, an individual or a value as a term."""
        return self._unknown(part.name) if isinstance(part, Unknown) else self.vocabulary.constant(part)

    def _unknown(self, name: str) -> Variable:
        if name not in self._unknowns:
            plain = "".join(c if c.isascii() and c.isalnum() else "_" for c in name).strip("_") or "X"
            wish = plain[0].upper() + plain[1:] if plain[0].isalpha() else f"V{plain}"
            taken = {v.name for v in self._unknowns.values()}
            free = next(w for w in chain([wish], (f"{wish}_{n}" for n in count(2))) if w not in taken)
            self._unknowns[name] = Variable(free)
        return self._unknowns[name]

    def know(self, names: Iterator[str]) -> None:
        """Give the variables of a rule their names before any other is needed."""
        for name in names:
            self._unknown(name)

    def held(self, on: Part, subject: Term, value: Term) -> Compound:
        """The statement that a property holds between two terms."""
        if isinstance(on, Expression) and on.name == "InverseOf":
            return self.held(on.args[0], value, subject)
        if not isinstance(on, Iri):
            raise Beyond(f"{cited(on)} is no property that a rule can ask for")
        if on.text.startswith(OWL):
            raise Beyond(f"{cited(on)} relates everything or nothing; leave it out, or name the property meant")
        if isinstance(value, Variable) and self.vocabulary.is_data(on):
            self.data.add(value)
        return Compound((self.vocabulary.name(on), subject, value))


def literal(*parts: Term) -> Literal:
    """A condition: a name or an operator with its arguments."""
    return Literal(Compound(parts))
