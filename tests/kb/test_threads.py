"""Threads that ask while others change: each question sees one state, and a snapshot keeps it."""

from __future__ import annotations

import sys
from concurrent.futures import ThreadPoolExecutor
from threading import Event

import pytest
from hypothesis import given
from hypothesis import strategies as st
from kanren import run, var
from programs import BASE, DERIVED, programs

from casper.kb.base import KnowledgeBase
from casper.kb.bottom_up import materialise as fixpoints
from casper.kb.errors import ProgramError
from casper.kb.goals.streams import lall
from casper.kb.store import model

INDICATORS = [*BASE.items(), *DERIVED.items()]
VALUES = ("a", "b", 1, 2)
LIGHTS = 12
CHANGES = 150
WIRING = "on(X) :- plug(P), feeds(P, X). on(X) :- wired(Y, X), on(Y). lit(X, Y) :- on(X), on(Y)."


@pytest.fixture(autouse=True)
def hasty():
    """Threads change places a thousand times as often as usual."""
    before = sys.getswitchinterval()
    sys.setswitchinterval(5e-6)
    yield
    sys.setswitchinterval(before)


@pytest.fixture(params=["rows", "columns"])
def lights(request, monkeypatch):
    """A row of lights that either of two plugs switches on, all at once."""
    if request.param == "columns":
        monkeypatch.setattr(fixpoints, "COLUMNS_FROM", 0)
    base = KnowledgeBase.from_text(f"{WIRING} :- dynamic(plug/1). :- dynamic(wired/2). feeds(left, 0). feeds(right, 0).")
    base.facts("wired", [(at, at + 1) for at in range(LIGHTS - 1)])
    return base


def stress(base, look, change, readers=3):
    """Look again and again, in several threads, while one makes its changes; what was seen, each thing once."""
    done, seen = Event(), set()

    def reader():
        while not done.is_set():
            seen.add(look())
        seen.add(look())

    with ThreadPoolExecutor(readers) as pool:
        looking = [pool.submit(reader) for _ in range(readers)]
        try:
            for at in range(CHANGES):
                change(at)
        finally:
            done.set()
        for each in looking:
            each.result(timeout=60)
    return seen


def switch(base):
    """The plug goes in and out."""
    return lambda at: base.retract("plug(left)") if at % 2 else base.assert_("plug(left)")


def hand_over(base):
    """One of the plugs is always in, so the lights stay on, though every row is taken back and given again."""
    base.assert_("plug(right)")

    def change(at):
        there, gone = ("left", "right") if at % 2 == 0 else ("right", "left")
        base.assert_(f"plug({there})")
        base.retract(f"plug({gone})")

    return change


def test_a_query_sees_all_lights_or_none(lights):
    assert stress(lights, lambda: len(list(lights.query("on(X)"))), switch(lights)) <= {0, LIGHTS}


def test_a_join_sees_all_pairs_or_none(lights):
    assert stress(lights, lambda: len(list(lights.query("on(X), lit(X, Y)"))), switch(lights)) <= {0, LIGHTS**2}


def test_what_holds_in_every_state_is_never_denied(lights):
    last = ("on", LIGHTS - 1)
    assert stress(lights, lambda: lights.ask(last), hand_over(lights)) == {True}


def test_what_holds_in_no_state_is_never_claimed(lights):
    assert stress(lights, lambda: lights.ask(("on", LIGHTS)), hand_over(lights)) == {False}


def test_a_kanren_goal_sees_all_lights_or_none(lights):
    x = var()
    assert stress(lights, lambda: len(run(0, x, lights.on(x))), switch(lights)) <= {0, LIGHTS}


def test_goals_of_one_snapshot_see_one_state(lights):
    x, y = var(), var()

    def look():
        now = lights.snapshot()
        return len(run(0, (x, y), lall(now.on(x), now.lit(x, y)))), len(run(0, x, now.on(x)))

    assert stress(lights, look, switch(lights)) <= {(0, 0), (LIGHTS**2, LIGHTS)}


def test_a_proof_is_of_one_state(lights):
    last = ("on", LIGHTS - 1)

    def look():
        proof = lights.why(last)
        return proof is not None and proof.height

    assert stress(lights, look, hand_over(lights)) == {LIGHTS}


def test_verdicts_of_several_threads_do_not_mix(lights):
    lights.rule("touch(X) :- wired(X, _)")
    lights.rule('never("it is off") :- claim(touch(X)), \\+ on(X)')
    lights.rule('never("it is the first") :- claim(touch(X)), feeds(_, X)')
    hand = hand_over(lights)

    def look():
        return tuple(lights.verify(("touch", at)).reasons for at in range(3))

    assert stress(lights, look, hand) == {(("it is the first",), (), ())}


def test_reasons_are_of_one_state(lights):
    def look():
        refusal = lights.why_not(("on", 1))
        return refusal is None or len(refusal.reasons) > 0

    assert stress(lights, look, switch(lights)) == {True}


def test_an_assumption_is_of_one_state_and_keeps_it(lights):
    lights.rule("dark(X) :- wired(X, _), \\+ on(X)")

    def look():
        supposed = lights.assume(("wired", LIGHTS - 1, LIGHTS))
        on, dark = len(list(supposed.query("on(X)"))), len(list(supposed.query("dark(X)")))
        return on, dark

    assert stress(lights, look, switch(lights)) <= {(0, LIGHTS), (LIGHTS + 1, 0)}


def test_several_threads_may_change_a_base(lights):
    def add(thread):
        for at in range(40):
            lights.assert_(("wired", f"{thread}-{at}", f"{thread}-{at + 1}"))

    with ThreadPoolExecutor(4) as pool:
        list(pool.map(add, range(4)))
    assert len(list(lights.rows("wired", 2))) == LIGHTS - 1 + 4 * 40


def test_facts_loaded_and_rules_stated_meanwhile_are_seen_whole_or_not_at_all(lights):
    lights.assert_("plug(left)")

    def look():
        now = lights.snapshot()
        return len(list(now.rows("wired", 2))) - len(list(now.rows("on", 1)))

    def change(at):
        lights.facts("wired", [(LIGHTS - 1 + at * 5 + more, LIGHTS + at * 5 + more) for more in range(5)])

    assert stress(lights, look, change, readers=1) == {-1}


# --- one thread is enough to see these -----------------------------------------------------------------------------


def test_a_query_under_way_goes_on_in_the_state_it_began_in(lights):
    lights.assert_("plug(left)")
    answers = lights.query("on(X)")
    found = [next(answers)]
    lights.retract("plug(left)")
    assert len([*found, *answers]) == LIGHTS
    assert list(lights.query("on(X)")) == []


def test_a_snapshot_cannot_be_changed():
    now = KnowledgeBase.from_text("human(ann).").snapshot()
    for change in (
        lambda: now.assert_("human(bob)"),
        lambda: now.retract("human(ann)"),
        lambda: now.fact("human(bob)"),
        lambda: now.rule("human(X) :- robot(X)"),
        lambda: now.facts("human", [("bob",)]),
        lambda: now.declare_statements([("human", 1)]),
    ):
        with pytest.raises(ProgramError, match="a snapshot stays as it is"):
            change()
    assert now.snapshot() is now
    assert now.assume("human(bob)").ask("human(bob)")


def test_a_snapshot_is_shared_until_something_changes_and_made_when_somebody_wants_it():
    base = KnowledgeBase.from_text("human(ann).")
    first = base.snapshot()
    assert base.snapshot() is first
    base.assert_("human(bob)")
    assert base.snapshot() is not first


def test_nothing_is_copied_for_snapshots_that_nobody_holds():
    base = KnowledgeBase.from_text("human(ann). agent(X) :- human(X).")
    base.snapshot()
    before = base._model
    base.assert_("human(bob)")
    assert base._model is before


def test_an_assumption_stays_as_it_is_when_the_base_changes():
    base = KnowledgeBase.from_text("human(ann). agent(X) :- human(X).")
    supposed = base.assume("human(bob)")
    base.assert_("human(eve)")
    base.retract("human(ann)")
    assert [answer["X"] for answer in supposed.query("agent(X)")] == ["ann", "bob"]
    assert [answer["X"] for answer in base.query("agent(X)")] == ["eve"]


def test_bulk_rows_of_an_assumption_are_its_own():
    base = KnowledgeBase()
    base.facts("human", [("ann",), ("bob",)])
    supposed = base.assume(without=["human(ann)"])
    base.retract("human(bob)")
    assert ("human(ann)" in base.to_text(), "human(bob)" in base.to_text()) == (True, False)
    assert ("human(ann)" in supposed.to_text(), "human(bob)" in supposed.to_text()) == (False, True)


changes = st.lists(
    st.tuples(st.sampled_from(["assert", "retract", "look"]), st.sampled_from(INDICATORS), st.tuples(*[st.sampled_from(VALUES)] * 3)),
    max_size=25,
)


def test_what_is_undefined_stays_so_however_many_snapshots_are_taken():
    base, kept = KnowledgeBase.from_text("n(a). small(X) :- n(X), X < 3."), []
    for at in range(20):
        kept.append(base.snapshot())
        base.assert_(("n", at))
    assert [each.truth("small(a)") for each in (*kept, base)] == ["undefined"] * 21
    assert base.truth(("small", 2)) == "true" and kept[2].truth(("small", 2)) == "false"


@given(programs(), changes, st.sampled_from([0, 1, 8]))
def test_every_snapshot_keeps_the_state_it_was_taken_in(text, sequence, layers):
    before, model.MOST_LAYERS = model.MOST_LAYERS, layers
    try:
        base, kept = KnowledgeBase.from_text(text), []
        for verb, (name, arity), values in sequence:
            if verb == "look":
                kept.append((base.snapshot(), states(base), base.to_text()))
            else:
                (base.assert_ if verb == "assert" else base.retract)((name, *values[:arity]))
        for snapshot, state, stated in kept:
            assert (states(snapshot), snapshot.to_text()) == (state, stated)
        assert states(base) == states(KnowledgeBase(base.clauses, INDICATORS))
    finally:
        model.MOST_LAYERS = before


def states(base):
    stored = {i: base.stored(i) for i in INDICATORS}
    return {i: (set(rows), set(rows.undefined or ())) for i, rows in stored.items()}
