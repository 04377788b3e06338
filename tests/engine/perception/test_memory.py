"""What was seen can be asked: the last steps by their time, episodes from when to when; what was not seen is undefined."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from casper.engine.perception.perception import Perception, PerceptionSettings
from casper.engine.perception.remembering.asked import ASKED, Memories
from casper.engine.perception.remembering.memory import MemorySettings, SensoryMemory
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError, Undefined
from casper.kb.text.reader import read_text

TEXT = """
:- dynamic mos/3, hold/3.
human(human).
visited(A, O, S) :- during(qdc(A, O, touch), From, To), S is To - From, S >= 2.
comes(A, O) :- qtc(T, A, O, toward), qdc(T, A, O, near).
touched_after(T) :- during(qdc(human, plate, touch), _, To), To > T.
"""


def worlds(xs, holding=()):
    """One who goes along a line to a plate at 4 m; None: not seen."""
    for t, x in enumerate(xs):
        hand = "cup" if t in holding else None
        agents = {} if x is None else {"human": AgentState(x, 0.0, 0.0, hand)}
        yield WorldState(float(t), agents, {"plate": ObjectState(4.0, 0.0)})


def watched(xs, holding=(), **bounds):
    memories, perception = Memories(MemorySettings(**bounds)), Perception(PerceptionSettings(), "human")
    for world in worlds(xs, holding):
        memories.update("human", world.t, perception.update(world))
    return memories


@pytest.fixture(scope="module")
def kb():
    base = KnowledgeBase()
    base.offer(ASKED)
    base.add(read_text(TEXT))
    return base


def test_steps_are_asked_by_their_time(kb):
    known = watched((0, 1, 2.5, 3.6, 3.6)).known(kb)
    assert list(known.query("qtc(T, human, plate, toward), qdc(T, human, plate, near), T >= 0")) == [{"T": 2.0}]
    assert known.ask("comes(human, plate)")
    assert known.ask("mos(4.0, human, stationary)") and known.truth("mos(4.0, human, moving)") == "false"


def test_episodes_are_asked_from_when_to_when(kb):
    known = watched((0, 3.6, 3.6, 3.6, 0)).known(kb)
    assert list(known.query("during(qdc(human, plate, touch), From, To), From >= 0")) == [{"From": 1.0, "To": 3.0}]
    assert known.ask("visited(human, plate, 2.0)")


def test_what_still_holds_lasts_until_now(kb):
    known = watched((0, 3.6, 3.6), holding=(1, 2)).known(kb)
    assert list(known.query("during(hold(human, cup), From, To), To > 0")) == [{"From": 1.0, "To": 2.0}]


def test_a_proof_says_that_it_was_seen(kb):
    proof = watched((0, 3.6, 3.6, 3.6)).known(kb).why("visited(human, plate, 2.0)")
    assert "during(qdc(human, plate, touch), 1.0, 3.0)   [seen]" in str(proof)


@pytest.mark.parametrize(
    "question",
    [
        "qdc(-1.0, human, plate, near)",  # before anybody watched
        "qdc(99.0, human, plate, near)",  # not yet
        "qdc(0.5, human, plate, near)",  # between two steps
        "mos(0.0, human, moving)",  # nothing to compare the first step with
        "qdc(1.0, human, cup, near)",  # a thing that was never seen
        "qdc(1.0, robot, plate, near)",  # somebody nobody watches
        "during(qdc(human, cup, near), 0.0, 1.0)",
        "during(qdc(robot, plate, near), 0.0, 1.0)",
        "during(near(human, plate), 0.0, 1.0)",  # no relation of those that are seen
        "during(qdc(human, plate, touch), From, To)",  # there may have been one before
    ],
)
def test_what_was_not_seen_is_undefined(kb, question):
    assert watched((0, 1)).known(kb).truth(question) == "undefined"


def test_without_anybody_who_watches_everything_is_undefined(kb):
    assert {kb.truth(q) for q in ("qdc(0.0, human, plate, far)", "comes(human, plate)", "hold(T, A, O)")} == {"undefined"}
    assert {Memories().known(kb).truth("hold(T, human, O)")} == {"undefined"}


def test_a_gap_is_unknown_and_what_comes_after_it_is_known(kb):
    known = watched((0, 0, None, 0)).known(kb)
    assert [known.truth(f"touched_after({t})") for t in (-5, 0, 1, 2, 3)] == ["undefined"] * 4 + ["false"]
    assert known.truth("qdc(2.0, human, plate, far)") == "undefined"


def test_who_is_out_of_sight_begins_anew(kb):
    known = watched((3.6, 3.6, None, 3.6)).known(kb)
    spans = {(0.0, 1.0), (3.0, 3.0)}
    assert {(e.begins, e.ends) for e in watched((3.6, 3.6, None, 3.6)).of["human"].episodes() if e.said[0] == "qdc"} == spans
    assert all(known.ask(f"during(qdc(human, plate, touch), {a}, {b})") for a, b in spans)


def test_a_long_day_is_remembered_within_bounds(kb):
    memories = watched([n % 2 * 3.6 for n in range(400)], steps=5, episodes=40)
    memory, known = memories.of["human"], memories.known(kb)
    assert memory.since == 395.0 and len({row[0] for row in memory.rows()["qdc"]}) == 5
    assert sum(1 for each in memory.episodes() if each.ends < 399) == 40
    assert known.truth("qdc(300.0, human, plate, touch)") == "undefined"
    assert known.truth("during(qdc(human, plate, touch), 301.0, 301.0)") == "undefined"  # it is forgotten
    assert known.ask("during(qdc(human, plate, touch), 397.0, 397.0)")


def test_things_that_come_and_go_for_ever_are_remembered_within_bounds(kb, monkeypatch):
    monkeypatch.setattr("casper.engine.perception.remembering.memory.MOST_THINGS", 50)
    memories, perception = Memories(), Perception(PerceptionSettings(), "human")
    for t in range(300):
        world = WorldState(float(t), {"human": AgentState(0.0, 0.0, 0.0)}, {f"thing{t}": ObjectState(1.0, 0.0)})
        memories.update("human", world.t, perception.update(world))
    assert len(memories.of["human"].kinds("qdc")) <= 50
    assert memories.known(kb).truth("during(qdc(human, thing3, near), 3.0, 3.0)") in ("true", "undefined")


places = st.lists(st.sampled_from([0.0, 2.5, 3.6, None]), min_size=1, max_size=30)


@settings(max_examples=40, deadline=None)
@given(places, st.integers(1, 6), st.integers(1, 4), st.integers(0, 30))
def test_the_more_is_remembered_the_more_is_known_and_nothing_is_told_otherwise(kb, xs, steps, episodes, asked):
    little = watched(xs, steps=steps, episodes=episodes).known(kb)
    much = watched(xs, steps=100, episodes=100).known(kb)
    for question in (
        f"qdc({asked}.0, human, plate, touch)",
        f"hold({asked}.0, human, cup)",
        f"touched_after({asked})",
        f"during(qdc(human, plate, near), {asked}.0, To)",
    ):
        assert little.truth(question) in ("undefined", much.truth(question)), question


def test_the_base_below_stays_as_it_is(kb):
    watched((0, 1)).known(kb)
    assert kb.truth("qdc(0.0, human, plate, far)") == "undefined"


def test_what_is_unknown_is_told_behind_what_is_known(kb):
    with pytest.raises(Undefined, match="some time before 0"):
        list(watched((0, 3.6)).known(kb).query("during(qdc(human, plate, touch), From, To)"))


def test_a_memory_of_nothing_is_refused():
    with pytest.raises(DomainError, match="at least one step"):
        SensoryMemory(steps=0)
