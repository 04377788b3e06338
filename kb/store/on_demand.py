"""What is worked out when it is needed: a large base answers questions from its facts until all rows are asked for.

Up to ``LISTED_UP_TO`` given facts everything that follows is listed at once, which makes the fastest answers. Beyond, a
question is answered top-down over indexes of the facts; the rows of the rules are listed when somebody enumerates them,
asks for a reason, or says ``:- stored(name/arity).``
"""

from __future__ import annotations

from collections.abc import Mapping

from casper.kb.bottom_up.circles.asked import fixed_columns
from casper.kb.errors import ProgramError
from casper.kb.program.program import Program
from casper.kb.program.refusals import undefined_sentence
from casper.kb.relations.relation import Relation
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Variable
from casper.kb.top_down.linking import Code

LISTED_UP_TO = 5_000
BEST_LISTED_UP_TO = 1_000  # of a program with a recursive minimum, which has a row for each pair of nodes
GIVEN = "given: "  # in front of the name of the facts of a predicate that has rules, too; no text can spell it bare
STATED = "stated: "  # the same of a predicate whose best rows alone are kept: a given row may be none of them


def listed_of(program: Program) -> frozenset[Indicator]:
    """The predicates whose rows can all be listed."""
    return frozenset(indicator for stratum in program.strata for indicator in stratum)


def check_storable(program: Program, indicator: Indicator) -> None:
    """Refuse ``:- stored(p/n).`` of a predicate that nobody defines, or whose rows cannot all be listed.

    Raises:
        ProgramError: with what to do.
    """
    if indicator not in program.rules:
        raise ProgramError(undefined_sentence(indicator, program.rules))
    if indicator in program.top_down:
        name, arity = indicator
        raise ProgramError(f"{name}/{arity} cannot be stored: its rows cannot all be listed; take the directive out")


def is_demanded(program: Program) -> bool:
    """Whether a program has more facts than are worth listing everything that follows from them.

    Where negation runs in a circle, or of a predicate only the best rows are kept and no question can name what they
    rest on, everything is listed all the same: that is how they are worked out. Where no rule gives anything, there is
    nothing more to list.
    """
    listed = listed_of(program)
    if program.circular or not all(fixed_columns(program, indicator) for indicator in program.least):
        return False
    if not any(program.rules[indicator] for indicator in listed):
        return False
    most = min(LISTED_UP_TO, BEST_LISTED_UP_TO) if program.least else LISTED_UP_TO
    return sum(len(program.given[indicator]) for indicator in listed) > most


def facts_of(program: Program) -> dict[Indicator, Relation]:
    """The given rows of the predicates that could be listed; of one with rules, under a name of their own."""
    found: dict[Indicator, Relation] = {}
    for indicator in listed_of(program):
        found[facts_key(program, indicator)] = Relation(*indicator, program.given[indicator])
    return found


def facts_key(program: Program, indicator: Indicator) -> Indicator:
    """Under which name the given rows of a predicate are kept."""
    if not program.rules[indicator]:
        return indicator
    return (STATED if indicator in program.least else GIVEN) + indicator[0], indicator[1]


def code_of(program: Program, facts: Mapping[Indicator, Relation]) -> Code:
    """The clauses to answer questions with, when only the facts are at hand."""
    listed = listed_of(program)
    clauses = {
        i: found
        for i, found in program.clauses.items()
        if i not in program.least and (i not in listed or program.rules[i])
    }
    for indicator in listed & clauses.keys():
        if len(facts[facts_key(program, indicator)]):
            clauses[indicator] = (_bridge(indicator), *clauses[indicator])
    total = sum(map(len, facts.values()))
    return Code(clauses, listed, lambda indicator: len(facts[indicator]) if indicator in facts else total)


def _bridge(indicator: Indicator) -> Clause:
    """The clause by which a predicate with rules has its facts, too."""
    name, arity = indicator
    args = [Variable(f"X{at}") for at in range(arity)]
    return Clause(Compound((name, *args)), (Literal(Compound((GIVEN + name, *args))),))


def index(program: Program, facts: Mapping[Indicator, Relation]) -> None:
    """Make the indexes that rules will look up by one column, so that the first question need not."""
    for clause in (clause for found in program.rules.values() for clause in found):
        for literal in clause.body:
            key, atom = literal.needed, literal.atom[2] if literal.is_aggregate else literal.atom
            if key is not None and key in facts and len(facts[key]) > LISTED_UP_TO and key[1] > 1:
                for column, arg in enumerate(atom.args):
                    if isinstance(arg, Variable) and _is_shared(arg, literal, clause):
                        facts[key].matching((column,), (None,))


def _is_shared(variable: Variable, literal: Literal, clause: Clause) -> bool:
    others = (x for x in clause.body if x is not literal)
    return variable in clause.head or any(variable in other.variables() for other in others)
