"""A recursive minimum for what is asked: from one node, where all nodes would be thousands of times the work.

Where every rule hands an argument on as it is, ``path(X, Y, D) :- path(X, Z, E), edge(Z, Y, W), D is E + W.`` its X,
rows of one X rest on rows of the same X alone. A question that names it is answered by the same rules with its value
in the argument's place: the same fixpoint (`minimum`) of a predicate without that argument.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace

from casper.kb.bottom_up.circles.minimum import least_rows
from casper.kb.bottom_up.size import MOST_ROWS, Room
from casper.kb.program.program import Program
from casper.kb.program.strata import needs
from casper.kb.relations.relation import Columns, Relation, Row
from casper.kb.relations.undefined import UndefinedRows
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import substitute

ASKED = "asked: "  # in front of the name of what has one argument less; no text can spell it bare


def fixed_columns(program: Program, indicator: Indicator) -> Columns:
    """The columns of a moded predicate that every rule hands on as they are; none where it rests on others' rules."""
    rules = program.rules[indicator]
    if any(other != indicator and program.rules.get(other, (None,)) for other in needs(rules)):
        return ()
    value = program.least[indicator].at
    return tuple(c for c in range(indicator[1]) if c != value and all(_hands_on(rule, c) for rule in rules))


def _hands_on(rule: Clause, column: int) -> bool:
    arg = rule.head.args[column]
    inner = [x.atom.args[column] for x in rule.body if x.needed == rule.head.indicator]
    if not isinstance(arg, Variable):
        return not inner and not isinstance(arg, tuple)
    return all(other == arg for other in inner)


def asked_rows(
    program: Program,
    indicator: Indicator,
    below: Mapping[Indicator, Relation],
    given: Sequence[Row],
    values: Mapping[int, Term],
) -> Relation:
    """The rows of a moded predicate that have those values in some of its `fixed_columns`.

    Args:
        below: the rows of what it needs.
        given: its own given rows with those values.

    Raises:
        BudgetExceeded: they improve without end.
    """
    name, arity = indicator
    kept = [column for column in range(arity) if column not in values]
    own = ASKED + name, len(kept)
    rules = [_narrowed(rule, own, kept, values) for rule in program.rules[indicator]]
    moded = program.least[indicator]
    narrow = replace(
        program,
        rules={**program.rules, own: tuple(rule for rule in rules if rule is not None)},
        given={**program.given, own: dict.fromkeys(tuple([row[c] for c in kept]) for row in given)},
        least={own: moded._replace(at=kept.index(moded.at))},
    )
    relations = {**below, own: Relation(*own, narrow.given[own])}
    least_rows(narrow, frozenset({own}), relations, Room(MOST_ROWS, relations), 0)
    found = relations[own]
    result = Relation(*indicator, (_widened(row, kept, values) for row in found))
    if found.undefined is not None:
        result.undefined = UndefinedRows(*indicator, [_widened(row, kept, values) for row in found.undefined])
    return result


def _narrowed(rule: Clause, own: Indicator, kept: Sequence[int], values: Mapping[int, Term]) -> Clause | None:
    """The rule for those values, without their columns; None where its head has others."""
    bindings: dict[Variable, Term] = {}
    for column, value in values.items():
        arg = rule.head.args[column]
        if isinstance(arg, Variable):
            if bindings.setdefault(arg, value) != value:
                return None
        elif arg != value:
            return None

    def narrow(atom: Compound, is_own: bool) -> Compound:
        filled = Compound(substitute(atom, bindings))
        return Compound((own[0], *(filled.args[column] for column in kept))) if is_own else filled

    body = [Literal(narrow(x.atom, x.needed == rule.head.indicator), x.negated, x.place) for x in rule.body]
    return Clause(narrow(rule.head, True), tuple(body), rule.place)


def _widened(row: Row, kept: Sequence[int], values: Mapping[int, Term]) -> Row:
    found = {**values, **dict(zip(kept, row))}
    return tuple([found[column] for column in range(len(found))])
