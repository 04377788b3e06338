"""Materialisation: the rows of every stored predicate, by semi-naive evaluation, stratum by stratum.

A row keeps the round in which it appeared. Rounds count up through all strata, so the premises of a row always come
from earlier rounds: that is all that `kb.reasons.why` needs to rebuild a well-founded proof. Within a stratum the round
is the least height of a proof.

Small programs are evaluated on Python rows; a program of plain rules that has, or comes to have, ``COLUMNS_FROM`` rows
and several for each rule goes to numpy columns (`kb.bottom_up.columnar`).
"""

from __future__ import annotations

from casper.kb.bottom_up.row_fixpoint import row_fixpoint
from casper.kb.bottom_up.size import MOST_ROWS
from casper.kb.errors import BudgetExceeded
from casper.kb.program.program import Program
from casper.kb.relations.relation import Relation
from casper.kb.terms.clauses import Indicator

COLUMNS_FROM = 2_000
MANY_RULES = 500  # from which it takes more rows: few for each rule are not worth a join on columns


def materialise(program: Program, most_rows: int = MOST_ROWS) -> dict[Indicator, Relation]:
    """All rows of every stored predicate.

    Raises:
        BudgetExceeded: more than ``most_rows`` rows were derived, or more than there is memory for.
    """
    try:
        return _materialised(program, most_rows)
    except MemoryError:
        pass  # what was derived is freed first
    raise BudgetExceeded("more facts follow than there is memory for: what follows is unknown")


def _materialised(program: Program, most_rows: int) -> dict[Indicator, Relation]:
    stored = [indicator for stratum in program.strata for indicator in stratum]
    if not any(program.rules[i] for i in stored):  # nothing follows: a join makes columns when one is asked for
        return row_fixpoint(program, most_rows)
    columns_from = COLUMNS_FROM * max(1, sum(len(program.rules[i]) for i in stored) // MANY_RULES)
    if sum(len(program.given[i]) for i in stored) < columns_from:
        try:
            return row_fixpoint(program, min(columns_from, most_rows))
        except BudgetExceeded:
            pass  # few facts can have many consequences: then it was a large program after all
    from casper.kb.bottom_up.columnar_fixpoint import columnar_fixpoint  # numpy is loaded for large programs only

    return columnar_fixpoint(program, most_rows) or row_fixpoint(program, most_rows)
