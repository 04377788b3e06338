"""The fixpoint on columns: the rows, and what is undefined, of the one on rows, and of its specification."""

from changing import plain_programs
from hypothesis import given
from programs import atoms_of, program_of, undefined_of

from casper.kb.bottom_up.columnar_fixpoint import columnar_fixpoint
from casper.kb.bottom_up.row_fixpoint import row_fixpoint
from casper.kb.bottom_up.specification import naive_fixpoint


@given(plain_programs(circles=True))
def test_the_fixpoint_on_columns_is_that_on_rows(text):
    program = program_of(text)
    found = columnar_fixpoint(program, 10**6)
    if found is None:  # a wildcard within a circle of negation
        assert program.circular
        return
    naive = naive_fixpoint(program)
    assert (atoms_of(found), undefined_of(found)) == (atoms_of(naive), undefined_of(naive))
    rows = row_fixpoint(program)
    for indicator, relation in found.items():
        assert len(relation) == len(rows[indicator])
        assert all(row in relation for row in rows[indicator])


@given(plain_programs())
def test_rows_appear_in_the_same_round_on_columns_where_there_is_one_stratum(text):
    program = program_of(text)
    if len(program.strata) == 1:
        found, rows = columnar_fixpoint(program, 10**6), row_fixpoint(program)
        for indicator, relation in found.items():
            assert relation.rows == rows[indicator].rows
