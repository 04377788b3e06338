"""The kitchen's relations answer alike in every direction."""

from functools import cache
from itertools import chain, combinations, product

import pytest
from kanren import run, var

from casper.engine.domain.domain import Domain
from casper.kb.terms.terms import Compound, Variable

AGENTS = ("human", "tiago")
THINGS = ("biscuits", "meal", "bottle", "plate", "glass", "sink", "hobs")
ACTIONS = ("pick_and_place", "eat", "sip", "cook", "wash")
SUBSETS = list(chain.from_iterable(combinations(range(3), n) for n in range(4)))
everything = list(product(AGENTS, THINGS, THINGS))


@cache
def kb():
    return Domain.load("kitchen").kb


@cache
def provable(action):
    return {row for row in everything if kb().ask((action, *row))}


@cache
def valid(action):
    return {row for row in everything if kb().verify((action, *row)).valid}


def test_eating_is_what_the_paper_says():
    assert provable("eat") == {("human", "biscuits", "plate"), ("human", "meal", "plate")}


def test_the_biscuits_go_to_the_plate_only_and_the_bottle_to_the_glass_only():
    placed = {(t, d) for _, t, d in valid("pick_and_place")}
    assert {d for t, d in placed if t == "biscuits"} == {"plate"}
    assert {d for t, d in placed if t == "bottle"} == {"glass"}


@pytest.mark.parametrize("bound", SUBSETS)
@pytest.mark.parametrize("action", ACTIONS)
def test_an_action_has_the_same_instances_whichever_parts_are_known(action, bound):
    for row in {tuple(row[at] if at in bound else None for at in range(3)) for row in everything}:
        parts = [Variable(f"P{at}") if part is None else part for at, part in enumerate(row)]
        expected = {r for r in provable(action) if all(p is None or p == q for p, q in zip(row, r))}
        assert {answer.args for answer in kb().instances((action, *parts))} == expected
        assert kb().ask((action, *parts)) is bool(expected)


@pytest.mark.parametrize("bound", SUBSETS)
def test_eating_is_the_same_relation_in_kanren(bound):
    for row in {tuple(row[at] if at in bound else None for at in range(3)) for row in everything}:
        parts = tuple(var() if part is None else part for part in row)
        expected = {r for r in provable("eat") if all(p is None or p == q for p, q in zip(row, r))}
        assert set(run(0, parts, kb().eat(*parts))) == expected


@pytest.mark.parametrize("bound", SUBSETS)
@pytest.mark.parametrize("action", ACTIONS)
def test_validity_is_the_same_relation_whichever_parts_are_known(action, bound):
    for row in sorted({tuple(row[at] if at in bound else "_" for at in range(3)) for row in everything})[::3]:
        expected = {r for r in valid(action) if all(p in ("_", q) for p, q in zip(row, r))}
        shown = ", ".join(part if part != "_" else f"P{at}" for at, part in enumerate(row))
        answers = kb().instances(f"valid({action}({shown}))")
        assert {answer[1].args for answer in answers} == expected
        assert kb().verify(f"{action}({', '.join(row)})").valid is bool(expected)


def test_every_valid_statement_is_listed_once_when_nothing_is_known():
    listed = [answer["S"] for answer in kb().query("valid(S)")]
    assert len(listed) == len(set(listed))
    assert set(listed) == {Compound((action, *row)) for action in ACTIONS for row in valid(action)}


@pytest.mark.parametrize("action", ACTIONS)
def test_whatever_is_invalid_has_a_reason_and_whatever_is_valid_has_none(action):
    for row in everything:
        refusal = kb().why_not((action, *row))
        assert (refusal is None) == (row in valid(action))
        assert refusal is None or all(reason for reason in refusal.reasons)


def test_every_valid_statement_has_a_proof():
    assert all(kb().why((action, *row)) for action in ACTIONS for row in valid(action))
