"""Poor sensors: noise estimated on the way, who walks, what is carried, what is not known."""

import itertools
import math
import random

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from casper.engine.perception.filters.handling import Handling, Near
from casper.engine.perception.filters.hands import told_of_hand
from casper.engine.perception.filters.quality import Gauge, Quality
from casper.engine.perception.filters.specification import PlainHandling
from casper.engine.perception.filters.steadying import Steadier
from casper.engine.perception.filters.walking import Way, smoothed
from casper.engine.perception.tracking import Tracker, TrackerSettings
from casper.engine.perception.world import AgentState, ObjectState, WorldState

PLACES = {"cup": (1.0, 0.0, 0.8), "pan": (3.0, 2.0, 0.9), "box": (-2.0, 1.0, 0.7), "jar": (0.0, 3.0, 1.0)}


def scene(t, source, noise, at=(0.0, 0.0), things=PLACES, lost=0.0):
    seen = {
        name: ObjectState(*(value + source.gauss(0, noise) for value in place))
        for name, place in things.items()
        if source.random() >= lost
    }
    human = AgentState(at[0] + source.gauss(0, noise), at[1] + source.gauss(0, noise), 0.0)
    return WorldState(t, {"human": human}, seen)


def resting(noise, steps=40, pace=0.5, lost=0.0, seed=1):
    source = random.Random(seed)
    return [scene(n * pace, source, noise, lost=lost) for n in range(steps)]


def carried(noise, seed=1, name="cup"):
    """The human stands by the cup for 6 s, carries it 4 m in 8 s, and stands for 6 s more."""
    source, worlds = random.Random(seed), []
    for n in range(40):
        t = n * 0.5
        x = min(max(t - 6.0, 0.0), 8.0) * 0.5
        things = {**PLACES, "cup": (1.0 + x, 0.0, 0.8 if t < 6.0 or t > 14.0 else 1.0)}
        worlds.append(scene(t, source, noise, (0.6 + x, 0.0), things))
    return [_renamed(world, {"cup": name}) for world in worlds]


def _renamed(world, names):
    return WorldState(world.t, world.agents, {names.get(name, name): o for name, o in world.objects.items()})


def steadied(worlds, **chosen):
    tracker = Tracker(TrackerSettings(**chosen))
    return [state for world in worlds for state in tracker.steps(world)], tracker


def test_the_noise_of_things_at_rest_is_estimated():
    gauge = Gauge()
    for world in resting(0.05):
        gauge.update(world)
    assert abs(gauge.quality.noise - 0.05) < 0.01


@pytest.mark.parametrize("present, poor", [([True] * 30, False), ([True, False, True] * 10, True)])
def test_who_is_watched_and_goes_missing_again_and_again_shows_that_detections_are_lost(present, poor):
    gauge, robot, ann = Gauge(), AgentState(0.0, 3.0, 0.0), AgentState(1.0, 1.0, 0.0)
    for t, is_seen in enumerate(present, 1):
        gauge.update(WorldState(0.5 * t, {"bot": robot} | ({"ann": ann} if is_seen else {}), {}))
    assert (gauge.quality.lost > TrackerSettings().steady_lost) == poor


def test_the_share_of_lost_detections_is_estimated_and_never_too_high_at_first():
    gauge, told = Gauge(), []
    for world in resting(0.01, 120, lost=0.4):
        told.append(gauge.update(world).lost)
    assert told[2] < 0.1 and 0.25 < told[-1] < 0.45


def test_a_good_sensor_is_tracked_as_ever():
    for pace in (0.1, 0.5, 1.0):
        worlds = resting(0.01, 60, pace, lost=0.02)
        usual = Tracker(TrackerSettings())
        assert steadied(worlds)[0] == [usual.update(world) for world in worlds]


def test_the_pace_of_a_slow_sensor_is_made_even():
    told = [state.t for state in steadied(resting(0.01, 20, 2.0))[0]]
    assert {round(b - a, 6) for a, b in itertools.pairwise(told[8:])} == {0.5}


def test_time_advances_through_the_change_to_filters():
    told = [state.t for state in steadied(resting(0.06))[0]]
    assert all(a < b for a, b in itertools.pairwise(told)) and len(told) > 30


def test_filters_at_rest_come_to_the_true_places():
    last = steadied(resting(0.06, 120))[0][-1]
    for name, place in PLACES.items():
        assert math.dist(place, (last.objects[name].x, last.objects[name].y, last.objects[name].z)) < 0.03
    assert math.hypot(last.agents["human"].x, last.agents["human"].y) < 0.03


def test_a_way_at_rest_becomes_surer_than_its_detections():
    way, source = Way(), random.Random(2)
    for n in range(50):
        way.seen(n * 0.5, source.gauss(0, 0.06), source.gauss(0, 0.06), 0.0036)
    assert way.last is not None and way.last.place < 0.0036


def test_smoothing_follows_a_walk_of_constant_speed():
    way, source = Way(), random.Random(4)
    for n in range(30):
        if n == 20:
            way.mark(10.0)
        way.seen(n * 0.5, 0.3 * n + source.gauss(0, 0.06), source.gauss(0, 0.06), 0.0036)
    found = way.at(10.0)
    assert found is not None and math.dist((found.x, found.y), (6.0, 0.0)) < 0.1 and abs(found.vx - 0.6) < 0.15


def test_what_moves_along_with_somebody_is_in_their_hand_though_no_hand_is_told_of():
    held = {state.t: state.agents["human"].holding for state in steadied(carried(0.06))[0]}
    assert [held[t] for t in (10.0, 12.0, 14.0)] == ["cup"] * 3


def test_what_was_put_down_is_in_no_hand_and_where_it_was_put():
    last = steadied(carried(0.06))[0][-1]
    assert last.agents["human"].holding is None
    assert math.hypot(last.objects["cup"].x - 5.0, last.objects["cup"].y) < 0.1


@settings(max_examples=5)
@given(st.integers(0, 10**6))
def test_nobody_walks_who_stands(seed):
    states = steadied(resting(0.06, seed=seed))[0][10:]
    steps = [
        math.hypot(b.agents["human"].x - a.agents["human"].x, b.agents["human"].y - a.agents["human"].y)
        for a, b in itertools.pairwise(states)
    ]
    assert sum(step > 0.045 for step in steps) <= 3  # what counts as moving, .09 m/s


@settings(max_examples=5)
@given(st.integers(0, 10**6), st.sampled_from(["a", "mug", "zebra"]))
def test_names_do_not_matter(seed, name):
    usual, other = steadied(carried(0.06, seed))[0], steadied(carried(0.06, seed, name))[0]
    for a, b in zip(usual, other, strict=True):
        renamed = _renamed(a, {"cup": name})
        assert b.objects == renamed.objects
        assert b.agents["human"].holding == {"cup": name}.get(a.agents["human"].holding, a.agents["human"].holding)


def test_nothing_is_known_of_somebody_who_is_not_seen_for_long():
    worlds = resting(0.06, 40)
    gone = [WorldState(w.t, {} if w.t > 10.0 else w.agents, w.objects) for w in worlds]
    present = {state.t: "human" in state.agents for state in steadied(gone)[0]}
    assert present[10.0] and not any(there for t, there in present.items() if t > 14.0)


def test_a_thing_never_seen_is_nowhere():
    assert all(set(state.objects) <= set(PLACES) for state in steadied(resting(0.06))[0])


def test_what_is_suddenly_elsewhere_is_reported_once_and_believed():
    source, reported = random.Random(3), []
    tracker = Tracker(TrackerSettings())
    for n in range(50):
        things = PLACES if n < 30 else {**PLACES, "pan": (-3.0, -3.0, 0.9)}
        states = tracker.steps(scene(n * 0.5, source, 0.05, things=things))
        reported += [(n, name) for name in tracker.jumps]
    assert [name for _, name in reported] == ["pan"] and reported[0][0] < 35
    assert math.hypot(states[-1].objects["pan"].x + 3.0, states[-1].objects["pan"].y + 3.0) < 0.1


def test_a_sensor_that_sees_a_plane_only_keeps_to_it():
    worlds = [
        WorldState(w.t, w.agents, {name: ObjectState(o.x, o.y) for name, o in w.objects.items()})
        for w in resting(0.06)
    ]
    assert all(thing.z is None for state in steadied(worlds)[0] for thing in state.objects.values())


def test_the_lag_grows_with_the_time_between_two_detections():
    quick, slow = Steadier(0.0), Steadier(0.0)
    for n in range(12):
        quick.update(resting(0.06, 12)[n], Quality(0.06, 0.0, 0.5))
        slow.update(resting(0.06, 12, 2.0)[n], Quality(0.06, 0.0, 2.0))
    assert quick.lag == 1.5 < slow.lag


def test_filters_can_be_switched_off():
    worlds = resting(0.06)
    usual = Tracker(TrackerSettings())
    assert steadied(worlds, steady=False)[0] == [usual.update(world) for world in worlds]


def test_a_long_pause_is_not_told_pace_by_pace_and_nothing_before_it_is_lost():
    plate = ObjectState(1.0, 0.0, 0.8)
    human = AgentState(0.0, 0.0, 0.0)
    steadier = Steadier(0.0)
    quality = Quality(0.06, 0.0, 0.5)
    times = [0.5 * n for n in range(1, 20)] + [1e6 + 0.5 * n for n in range(20)]
    told = [w for t in times for w in steadier.update(WorldState(t, {"human": human}, {"plate": plate}), quality)]
    assert len(told) < 200
    assert all(early.t < late.t for early, late in itertools.pairwise(told))
    before, after = [w for w in told if w.t < 100], [w for w in told if w.t > 1e6]
    assert "human" in before[10].agents and "human" in after[-1].agents
    assert after[-1].t >= 1e6 + 9.0
    assert all("plate" in w.objects for w in (*before[5:], *after))


SOMETIMES = st.lists(
    st.tuples(st.booleans(), st.floats(0.0, 1.0), st.floats(-2.0, 2.0), st.floats(-2.0, 2.0)), min_size=1, max_size=12
)


@given(SOMETIMES)
def test_gains_that_are_kept_smooth_as_those_worked_out_anew(moments):
    way, t = Way(kept=8), 0.0
    for is_seen, dt, x, y in moments:
        t += dt
        way.seen(t, x, y, 0.01) if is_seen else way.mark(t)
    for node in way.nodes:
        found = None
        for each in reversed(way.nodes):
            if each.t < node.t:
                break
            found = each if found is None else smoothed(each, found)
        assert way.at(node.t) == found


SEEN = st.none() | st.tuples(*[st.floats(-0.5, 0.5)] * 3)
WHO = st.none() | st.builds(Near, st.sampled_from(("ann", "bob")), *[st.floats(-0.6, 0.6)] * 4)
MOMENTS = st.lists(st.tuples(SEEN, WHO, st.floats(0.0, 1.0), st.sampled_from((0.02, 0.1))), min_size=1, max_size=25)
CARRIED = st.sampled_from((0.0001, 0.02, 0.5))


def handled(moments, carried, is_flat):
    """The thing, and the plain one, after the same moments; and their times."""
    start = ObjectState(0.0, 0.0, None if is_flat else 0.9)
    thing, plain, times = Handling(0.0, start, 0.0009, carried), PlainHandling(0.0, start, 0.0009, carried), [0.0]
    for spot, near, later, noise in moments:
        t = times[-1] + later
        dt = t - times[-1]
        seen = None if spot is None else ObjectState(spot[0], spot[1], None if is_flat else 0.9 + spot[2])
        told = told_of_hand(0.5, False, near is not None and seen is not None)
        if near is not None or not both(thing.lies(t, seen, noise), plain.lies(t, seen, noise)):
            by, gone, place = None, (0.0, 0.0), None
            if near is not None:
                by, gone, place = near.name, (near.vx * dt, near.vy * dt), (near.x, near.y)
            jumped = plain.update(t, plain.expect(dt, by, gone), by, seen, noise, told, place)
            assert thing.update(t, near, seen, noise, told) == jumped
        times.append(t)
    return thing, plain, times


def both(one, other):
    assert one == other
    return one


@given(MOMENTS, CARRIED, st.booleans())
def test_a_handled_thing_is_where_the_plain_filters_have_it(moments, carried, is_flat):
    thing, plain, times = handled(moments, carried, is_flat)
    assert (thing.rest, thing.hand, thing.home) == (plain.rest, plain.hand, plain.home)
    assert thing.carried == plain.carried
    for t in (-1.0, *times):
        assert thing.at(t) == plain.at(t)
