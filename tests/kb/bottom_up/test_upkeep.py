"""Facts that come and go: the rows in step with a fresh start, overlays that leave the base alone."""

from contextlib import nullcontext, suppress
from itertools import islice

import pytest
from changing import apply, changes, fresh, meaning, plain_programs
from hypothesis import given
from kanren import run, var
from programs import BASE, DERIVED, programs

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up import materialise as fixpoints
from casper.kb.errors import Undefined

raises = pytest.raises


@given(programs(circles=True), changes())
def test_after_every_change_the_rows_are_those_of_a_fresh_start(text, sequence):
    base = KnowledgeBase.from_text(text)
    for change in sequence:
        apply(base, change)
        assert meaning(base) == fresh(base)


@given(plain_programs(circles=True), changes())
def test_changes_on_columns_end_in_a_fresh_start_too(text, sequence):
    before, fixpoints.COLUMNS_FROM = fixpoints.COLUMNS_FROM, 0
    try:
        base = KnowledgeBase.from_text(text)
        for change in sequence:
            apply(base, change)
        assert meaning(base) == fresh(base)
    finally:
        fixpoints.COLUMNS_FROM = before


@given(programs(circles=True), changes(), changes())
def test_an_assumption_is_a_fresh_start_with_the_changes_and_leaves_the_base_alone(text, first, then):
    base = KnowledgeBase.from_text(text)
    for change in first:
        apply(base, change)
    before, clauses = meaning(base), base.clauses
    supposed = base.assume()
    for change in then:
        apply(supposed, change)
    assert meaning(supposed) == fresh(supposed)
    assert (meaning(base), base.clauses) == (before, clauses)
    assert meaning(base) == fresh(base)


@given(programs(circles=True), changes())
def test_ask_the_goal_and_the_rows_agree_after_changes(text, sequence):
    base = KnowledgeBase.from_text(text)
    for change in sequence:
        with suppress(Undefined):
            base.ask(change[1])  # an answer remembered from before must not survive the change
        apply(base, change)
    for name, arity in {**BASE, **DERIVED}.items():
        relation = base.stored((name, arity))
        rows, undefined = set(relation), set(relation.undefined or ())
        free = tuple(var() for _ in range(arity))
        with raises(Undefined) if undefined else nullcontext():
            assert set(run(0, free, base.predicate(name)(*free))) == rows
        assert set(islice(base.rows(name, arity), len(rows))) == rows
        assert set(run(len(rows), free, base.predicate(name)(*free)) if rows else ()) == rows
        for row in [*rows, *undefined, ("a",) * arity]:
            expected = "true" if row in rows else "undefined" if row in undefined else "false"
            assert base.truth((name, *row)) == expected
            with raises(Undefined) if expected == "undefined" else nullcontext():
                assert base.ask((name, *row)) == (row in rows)
