"""The benchmarks of perception at tiny sizes: pair by pair, streams and batches say the same. No time is judged."""

import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
if str(ROOT / "benchmarks" / "perception") not in sys.path:
    sys.path.append(str(ROOT / "benchmarks" / "perception"))

from long_streams import repeated  # noqa: E402
from reference import check, pair_by_pair  # noqa: E402
from scenes import seen, walk  # noqa: E402

from casper import qsr  # noqa: E402
from casper.engine.perception.world import AgentState, ObjectState, WorldState  # noqa: E402
from casper.qsr.calculi.table import CALCULI, calculus  # noqa: E402


@pytest.mark.parametrize("name", sorted(set(CALCULI) - {"block"}))
def test_a_trace_is_told_as_pair_by_pair(name):
    trace = walk(12, 4)
    told = pair_by_pair([calculus(name)], trace.t.tolist(), seen(trace), "human")
    check(qsr.relations(trace, name, observer="human"), told)
    assert any(holds[name] for holds in told)


def test_other_answers_are_refused():
    trace = walk(3, 2)
    told = pair_by_pair([calculus("qdc")], trace.t.tolist(), seen(trace), "human")
    told[1] = {"qdc": {}}
    with pytest.raises(AssertionError, match="different answers at step 1"):
        check(qsr.relations(trace, "qdc", observer="human"), told)


def test_a_recording_is_repeated_at_ten_states_a_second_without_end():
    states = [WorldState(t, {"human": AgentState(t, 0.0, 0.0)}, {"cup": ObjectState(1.0, 0.0)}) for t in (2.0, 3.0, 4.0)]
    found = list(repeated(states, 10.0, 0.0))
    assert [world.t for world in found] == [n / 10 for n in range(100)]
    assert [round(world.agents["human"].x, 6) for world in found[:25:5]] == [2.0, 2.5, 3.0, 3.5, 4.0]
    assert found[25].agents["human"].x == found[0].agents["human"].x
