"""Facts, rules and constraints in Python, in a form that type-checkers understand and that prints back to the text.

    >>> human, agent = predicate("human", 1), predicate("agent", 1)
    >>> X = variable("X")
    >>> kb = Author()
    >>> kb.add_fact(human("ann"))
    >>> kb.add_rule(agent(X), human(X), X != "bob")
    >>> print(kb.to_text(), end="")
    human(ann).
    agent(X) :- human(X), X \\= bob.

``~p(X)`` is a condition negated, ``X == Y``, ``X != Y``, ``X < Y``, ``X <= Y`` … compare, ``N.equals(M + 1)`` computes.
A `Var` compares into a condition, so it has no truth value; it never gets into a term, where it is a plain `Variable`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, NoReturn, TypeAlias

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, make_list
from casper.kb.terms.unification import is_ground
from casper.kb.text.writer import literal_text

if TYPE_CHECKING:
    from collections.abc import Sequence

Value: TypeAlias = "str | int | float | Var | Expression | Atom | Sequence[Value]"
"""What can stand in a statement: a constant, a variable, an expression, a statement (in ``claim``), a list of these."""


class Expression:
    """A term that can be compared and computed with."""

    __slots__ = ("term",)

    def __init__(self, term: Term) -> None:
        self.term = term

    def __eq__(self, other: Value) -> Condition:  # type: ignore[override]
        return _compared("=", self, other)

    def __ne__(self, other: Value) -> Condition:  # type: ignore[override]
        return _compared("\\=", self, other)

    def __lt__(self, other: Value) -> Condition:
        return _compared("<", self, other)

    def __le__(self, other: Value) -> Condition:
        return _compared("=<", self, other)

    def __gt__(self, other: Value) -> Condition:
        return _compared(">", self, other)

    def __ge__(self, other: Value) -> Condition:
        return _compared(">=", self, other)

    def equals(self, other: Value) -> Condition:
        """``N is M + 1``: the value of an expression."""
        return _compared("is", self, other)

    def __add__(self, other: Value) -> Expression:
        return Expression(Compound(("+", self.term, term_of(other))))

    def __radd__(self, other: Value) -> Expression:
        return Expression(Compound(("+", term_of(other), self.term)))

    def __rsub__(self, other: Value) -> Expression:
        return Expression(Compound(("-", term_of(other), self.term)))

    def __rmul__(self, other: Value) -> Expression:
        return Expression(Compound(("*", term_of(other), self.term)))

    def __sub__(self, other: Value) -> Expression:
        return Expression(Compound(("-", self.term, term_of(other))))

    def __mul__(self, other: Value) -> Expression:
        return Expression(Compound(("*", self.term, term_of(other))))

    def __truediv__(self, other: Value) -> Expression:
        return Expression(Compound(("/", self.term, term_of(other))))

    def __hash__(self) -> int:
        return hash(self.term)

    def __bool__(self) -> NoReturn:
        raise TypeError(f"{self!r} stands for something unknown; it is neither true nor false")

    def __repr__(self) -> str:
        return term_text(self.term)


class Var(Expression):
    """A logic variable to write rules with."""

    __slots__ = ()


@dataclass(frozen=True, slots=True, eq=False)
class Condition:
    """One condition of a rule: a statement, perhaps negated, or a comparison."""

    literal: Literal

    def __invert__(self) -> Condition:
        """The condition negated; twice is not at all."""
        return Condition(Literal(self.literal.atom, not self.literal.negated))

    def __bool__(self) -> NoReturn:
        raise TypeError(f"{self!r} is a condition of a rule, neither true nor false; ask a knowledge base")

    def __repr__(self) -> str:
        return literal_text(self.literal)


class Atom(Condition):
    """A statement: a predicate of something. It can be a fact, the head of a rule, or a condition."""

    __slots__ = ()

    @property
    def compound(self) -> Compound:
        """The statement as the knowledge base knows it; every method of it that takes a statement takes this."""
        return self.literal.atom


@dataclass(frozen=True, slots=True)
class PredicateName:
    """A predicate to write statements with: ``eat("human", X, "plate")``."""

    name: str
    arity: int

    def __call__(self, *args: Value) -> Atom:
        """The statement about the arguments.

        Raises:
            ProgramError: there are too many or too few.
        """
        if len(args) != self.arity:
            noun = "argument" if self.arity == 1 else "arguments"
            raise ProgramError(f"{self.name} takes {self.arity} {noun}, not {len(args)}")
        return Atom(Literal(Compound((self.name, *map(term_of, args)))))

    def __repr__(self) -> str:
        return f"{self.name}/{self.arity}"


def predicate(name: str, arity: int) -> PredicateName:
    """A predicate by its name and number of arguments."""
    return PredicateName(name, arity)


def variable(name: str) -> Var:
    """A variable by its name, which starts with a capital letter or ``_``.

    Raises:
        ProgramError: it does not, so the text could not be read in again.
    """
    if not (name.isidentifier() and name.isascii() and (name[0].isupper() or (name[0] == "_" and name != "_"))):
        raise ProgramError(f"{name!r} is no name for a variable: it starts with a capital letter, like X or Food")
    return Var(Variable(name))


def variables(names: str) -> tuple[Var, ...]:
    """Several variables: ``A, T, D = variables("A T D")``."""
    return tuple(variable(name) for name in names.split())


claim, did, valid = PredicateName("claim", 1), PredicateName("did", 2), PredicateName("valid", 1)


def term_of(value: Value) -> Term:
    """A Python value as a term.

    Raises:
        ProgramError: it is none: True and None have no meaning here, nor has a negated condition.
    """
    if isinstance(value, Expression):
        return value.term
    if isinstance(value, Atom) and not value.literal.negated:
        return as_term(value.compound)
    if isinstance(value, (str, int, float)) and not isinstance(value, bool):
        return value
    if isinstance(value, (list, tuple)):
        return make_list(map(term_of, value))
    raise ProgramError(f"{value!r} cannot stand in a statement: a name, a number, a variable or a list can")


def _compared(operator: str, left: Expression, right: Value) -> Condition:
    return Condition(Literal(Compound((operator, left.term, term_of(right)))))


class Author(KnowledgeBase):
    """A knowledge base that is written in Python; it is asked like any other.

    ``Author()`` starts empty; ``add``, ``fact`` and ``rule`` still take text, and both can be mixed.
    """

    def add_fact(self, *facts: Atom) -> None:
        """State facts.

        Raises:
            ProgramError: one has a variable.
        """
        for fact in facts:
            if not is_ground(fact.compound):
                raise ProgramError(f"{fact!r} has a variable; state a rule for what holds of everything")
        self.add([Clause(fact.compound) for fact in facts])

    def add_rule(self, head: Atom, *body: Condition) -> None:
        """State that the head holds when all of the body does; several rules of one head are alternatives."""
        self.add([rule(head, *body)])

    def add_constraint(self, sentence: str, *body: Condition) -> None:
        """State what never is: the sentence is what a person is shown when the body holds."""
        self.add([constraint(sentence, *body)])


def rule(head: Atom, *body: Condition) -> Clause:
    """A clause: for ``KnowledgeBase.add([rule(agent(X), human(X))])``."""
    if head.literal.negated:
        raise ProgramError(f"{head!r} cannot be the head of a rule: it is negated")
    return Clause(head.compound, tuple(condition.literal for condition in body))


def constraint(sentence: str, *body: Condition) -> Clause:
    """A constraint: what the body describes is never so."""
    return Clause(Compound(("never", sentence)), tuple(condition.literal for condition in body))
