"""What is gone, and what is only lost by a sensor."""

from hypothesis import given
from hypothesis import strategies as st

from casper.engine.perception.filters.absence import Absences
from casper.engine.perception.filters.quality import Quality
from casper.engine.perception.world import ObjectState

CUP, PLATE, FAR = ObjectState(0.0, 0.0), ObjectState(0.1, 0.0), ObjectState(4.0, 0.0)
SPOTS = {"cup": (0.0, 0.0), "plate": (0.1, 0.0), "far": (4.0, 0.0)}


def after(steps, lost=0.02):
    absences = Absences()
    for seen in steps:
        absences.update(seen, SPOTS, Quality(0.05, lost, 0.5))
    return absences


def test_what_goes_unseen_beside_what_is_seen_is_gone():
    absences = after([{"plate": PLATE}] * 6)
    assert absences.is_gone("cup") and not absences.is_gone("plate")


def test_one_lost_detection_is_no_absence():
    assert not after([{"plate": PLATE}]).is_gone("cup")


@given(st.lists(st.booleans(), max_size=60))
def test_nothing_is_gone_where_nothing_beside_it_is_seen(looks):
    assert not after([{"far": FAR} if look else {} for look in looks]).is_gone("cup")


@given(st.integers(1, 60), st.floats(0.0, 0.9))
def test_what_is_seen_again_was_not_gone(steps, lost):
    assert not after([*[{"plate": PLATE}] * steps, {"cup": CUP, "plate": PLATE}], lost).is_gone("cup")


@given(st.floats(0.0, 0.7), st.floats(0.0, 0.7))
def test_the_more_detections_are_lost_the_later_something_is_gone(one, other):
    def steps(lost):
        return next(n for n in range(1, 200) if after([{"plate": PLATE}] * n, lost).is_gone("cup"))

    low, high = sorted((one, other))
    assert steps(low) <= steps(high)


def test_of_a_sensor_that_loses_nearly_everything_nothing_is_said():
    assert not after([{"plate": PLATE}] * 500, 0.8).is_gone("cup")
