"""Grammars as they are: tables of tasks, and libraries that are never unrolled."""

import pytest

from casper.kb.base import KnowledgeBase
from casper.kb.errors import PlanError, Undefined
from casper.plans.grammar.expansion import Unlisted
from casper.plans.library import PlanLibrary
from casper.plans.networks.tables import NEVER, Tables
from casper.plans.relations import plan_clauses


def tables(text):
    return PlanLibrary.from_text(text).tables


def names(mask, found):
    return sorted(name for (name, _), bit in found.bit.items() if mask & bit)


def test_the_fewest_leaves_of_a_task_are_those_of_its_shortest_way():
    found = tables("goal(g). g --> t, (a ; t, b), optional(c), repeat(d, 2, 3). t --> a, t. t --> b, b. t --> {p}, a, c, d.")
    assert found.least == {("g", 0): 5, ("t", 0): 2}


def test_a_task_begins_with_what_nothing_must_come_before():
    found = tables("goal(g). g --> t, u. t --> []. t --> a, b. u --> steps([x: c, y: d], [x < y]). u --> unordered(e, f).")
    assert names(found.first["g", 0], found) == ["a", "c", "e", "f"]
    assert names(found.contained["g", 0], found) == ["a", "b", "c", "d", "e", "f"]


def test_what_only_goes_on_for_ever_has_no_fewest_leaves_and_its_circle_is_told():
    found = tables("goal(g). g --> a ; h. h --> i, a. i --> h.")
    assert (found.least["h", 0], found.least["g", 0]) == (NEVER, 1)
    assert [[name for name, _ in circle] for circle, _ in found.endless()] == [["h", "i"]]


def test_a_recursive_library_is_not_listed_and_says_so():
    library = PlanLibrary.from_text("goal(g(_)). g(X) --> a(X), g(X). g(X) --> b(X).")
    assert (library.is_listed, library.goals, sorted(library.actions)) == (False, ("g",), [("a", 1), ("b", 1)])
    for _ in range(2):
        with pytest.raises(Unlisted, match=r"the task g contains itself \(g needs g\), so its plans are not listed"):
            _ = library.ways
    assert str(PlanLibrary.from_text(library.to_text())) == str(library)


def test_a_library_of_too_many_plans_costs_what_its_text_does():
    rules = " ".join(f"t{n}(X) --> t{n + 1}(X), t{n + 1}(Y), a(Y)." for n in range(330))
    library = PlanLibrary.from_text(f"goal(g). g --> t0(_). {rules} t330(b) --> b. t330(c) --> c.")
    assert not library.is_listed
    assert library.tables.least["g", 0] > 10**90


def test_the_relations_of_plans_that_are_not_listed_are_undefined():
    kb = KnowledgeBase()
    kb.add(plan_clauses(PlanLibrary.from_text("goal(g). g --> a(plate), g. g --> b.")))
    assert list(kb.rows("task", 1)) == [("g",)]
    with pytest.raises(Undefined, match="the plans have no end or are too many, so their steps are not listed"):
        kb.ask("uses(g, plate)")


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("goal(g). goal(h). g --> a, g. g --> b.", "the goal h has no production: write h --> …"),
        ("goal(g(1)). g(2) --> a, g(2). g(2) --> b.", "no production fits the goal g(1)"),
        ("goal(g). g --> t. t --> t. t --> {p}, [].", "a plan of g has no action at all"),
        ("goal(g). g --> a, g. g --> 3.", "3 cannot stand in a plan"),
    ],
)
def test_mistakes_of_a_library_that_is_not_listed_are_told_when_it_is_loaded(text, sentence):
    with pytest.raises(PlanError) as caught:
        PlanLibrary.from_text(text, "home.pl")
    assert sentence in str(caught.value) and caught.value.place.file == "home.pl"


def test_each_task_of_a_chain_is_looked_at_once(monkeypatch):
    library = PlanLibrary.from_text("goal(t0). " + " ".join(f"t{n} --> a, t{n + 1}." for n in range(300)) + " t300 --> z.")
    looked, contained_in = [], Tables.contained_in
    monkeypatch.setattr(Tables, "contained_in", lambda self, *given: looked.append(given) or contained_in(self, *given))
    tables = Tables(library.tables.grammar)
    assert tables.contained["t0", 0] == tables.bit["a", 0] | tables.bit["z", 0]
    assert len(looked) == 301
