"""Which tasks lie between a goal and its leaves, where plans are not listed."""

from __future__ import annotations

import networkx as nx

from casper.engine.domain.domain import Domain

ONTOLOGY = """human(ann). truck(t1). boat(b1). spot(here). spot(there).
go(A, V, S) :- human(A), spot(S), truck(V). go(A, V, S) :- human(A), spot(S), boat(V).
load(A, V) :- human(A). sing(A) :- human(A). rest(A) :- human(A)."""
PLANS = """goal(bring). goal(trip).
bring --> fetch, onward. onward --> []. onward --> by_land(t1, here), onward.
fetch --> by_land(V, there), load(V).
by_land(V, S) --> {truck(V)}, go(V, S).
by_land(V, S) --> {boat(V)}, go(V, S).
trip --> unordered((sing, more), (rest, load(t1))). more --> []. more --> sing, more."""


def nested(tree: nx.DiGraph, node: int = 0) -> object:
    below = [nested(tree, child) for child in tree.successors(node)]
    return (tree.nodes[node]["term"], *below) if below else tree.nodes[node]["term"]


def read(*actions: str) -> nx.DiGraph:
    reading = Domain.from_text(ontology=ONTOLOGY, plans=PLANS).reading()
    for action in actions:
        reading.observe(action)
    assert reading.first is not None
    return reading.first.tree()


def lived(*actions: str) -> nx.DiGraph:
    day = Domain.from_text(ontology=ONTOLOGY, plans=PLANS).day(most_missed=0)
    for action in actions:
        day.observe(action)
    return day.episodes[-1].tree()


def test_a_reading_shows_the_tasks_of_what_was_done_and_of_what_is_left() -> None:
    assert nested(read("go(t1, there)")) == (
        "bring",
        ("fetch", ("by_land(t1, there)", "go(t1, there)"), "load(t1)"),
        "onward",
    )


def test_a_task_within_itself_is_shown_as_deep_as_it_was_done() -> None:
    tree = read("go(b1, there)", "load(b1)", "go(t1, here)", "go(t1, here)")
    ride = ("by_land(t1, here)", "go(t1, here)")
    assert nested(tree) == (
        "bring",
        ("fetch", ("by_land(b1, there)", "go(b1, there)"), "load(b1)"),
        ("onward", ride, ("onward", ride, "onward")),
    )


def test_a_task_is_observed_when_all_its_leaves_are() -> None:
    tree = read("go(t1, there)", "load(t1)")
    status = {data["term"]: data["status"] for _, data in tree.nodes(data=True)}
    assert status["fetch"] == "observed"
    assert {data["kind"] for _, data in tree.nodes(data=True)} == {"goal", "task", "action"}


def test_what_is_done_in_any_order_hangs_where_the_plan_has_it() -> None:
    told = nested(lived("sing", "rest", "sing", "load(t1)"))
    assert told == ("trip", "sing", ("more", "sing", "more"), "rest", "load(t1)")


def test_leaves_keep_the_order_in_which_they_were_done() -> None:
    tree = lived("sing", "rest", "sing", "load(t1)")
    leaves = {data["leaf"]: data["term"] for _, data in tree.nodes(data=True) if data["kind"] == "action"}
    assert [leaves[at] for at in sorted(leaves)] == ["sing", "rest", "sing", "load(t1)"]
