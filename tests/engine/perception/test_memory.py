"""What was seen can be asked: the last steps by their time, episodes from when to when, bounded in memory."""

import pytest

from casper.engine.perception.memory import SensoryMemory
from casper.engine.perception.perception import Perception, PerceptionSettings
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError

TEXT = """
:- dynamic qdc/4, qtc/4, mos/3, hold/3, during/3.
human(human).
visited(A, O, S) :- during(qdc(A, O, touch), From, To), S is To - From, S >= 2.
comes(A, O) :- qtc(T, A, O, toward), qdc(T, A, O, near).
"""


def remembered(xs, holding=(), **bounds):
    """One who goes along a line to a plate at 4 m; None: not seen."""
    memory, perception = SensoryMemory(**bounds), Perception(PerceptionSettings(), "human")
    for t, x in enumerate(xs):
        hand = "cup" if t in holding else None
        agents = {} if x is None else {"human": AgentState(x, 0.0, 0.0, hand)}
        memory.update(perception.update(WorldState(float(t), agents, {"plate": ObjectState(4.0, 0.0)})))
    return memory


@pytest.fixture(scope="module")
def kb():
    return KnowledgeBase.from_text(TEXT)


def test_steps_are_asked_by_their_time(kb):
    known = remembered((0, 1, 2.5, 3.6, 3.6)).known(kb)
    assert list(known.query("qtc(T, human, plate, toward), qdc(T, human, plate, near)")) == [{"T": 2.0}]
    assert [row["O"] for row in known.query("comes(human, O)")] == ["plate"]
    assert known.ask("mos(4.0, human, stationary)")


def test_episodes_are_asked_from_when_to_when(kb):
    known = remembered((0, 3.6, 3.6, 3.6, 0)).known(kb)
    assert list(known.query("during(qdc(human, plate, touch), From, To)")) == [{"From": 1.0, "To": 3.0}]
    assert list(known.query("visited(human, plate, S)")) == [{"S": 2.0}]


def test_what_still_holds_lasts_until_now(kb):
    known = remembered((0, 3.6, 3.6), holding=(1, 2)).known(kb)
    assert list(known.query("during(hold(human, cup), From, To)")) == [{"From": 1.0, "To": 2.0}]


def test_who_is_out_of_sight_begins_anew(kb):
    known = remembered((3.6, 3.6, None, 3.6)).known(kb)
    spans = [(row["From"], row["To"]) for row in known.query("during(qdc(human, plate, touch), From, To)")]
    assert sorted(spans) == [(0.0, 1.0), (3.0, 3.0)]


def test_a_long_day_is_remembered_within_bounds():
    memory = remembered([n % 2 * 3.0 for n in range(400)], steps=5, episodes=7)
    assert len({row[0] for row in memory.rows()["qdc"]}) == 5
    assert sum(1 for each in memory.episodes() if each.ends < 399) == 7
    assert memory.since == 395.0


def test_the_base_below_stays_as_it_is(kb):
    remembered((0, 1)).known(kb)
    assert not kb.ask("qdc(0.0, human, plate, far)")


def test_a_memory_of_nothing_is_refused():
    with pytest.raises(DomainError, match="at least one step"):
        SensoryMemory(steps=0)
