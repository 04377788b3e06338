"""The benchmark of a trial on one trial: the physics as it is shipped ends as the plain one does. No time is judged."""

import importlib.util
import sys
from functools import cache
from pathlib import Path

import pytest

pytest.importorskip("mujoco")

from casper import Domain

FILE = Path(__file__).resolve().parent.parent / "benchmarks" / "trial.py"
SPEC = importlib.util.spec_from_file_location("benchmark_of_a_trial", FILE)
assert SPEC is not None and SPEC.loader is not None
BENCHMARK = sys.modules[SPEC.name] = importlib.util.module_from_spec(SPEC)
SPEC.loader.exec_module(BENCHMARK)
difference, run = BENCHMARK.difference, BENCHMARK.run


@cache
def shipped():
    return run(Domain.load("kitchen"), "breakfast", 3, is_plain=False)


def test_sleeping_and_larger_steps_change_no_result():
    assert difference(run(Domain.load("kitchen"), "breakfast", 3, is_plain=True), shipped(), period=0.5) == ""


def test_another_result_is_noticed():
    events = list(shipped().events)
    last = events[-1]
    events[-1] = last.__class__(last.type, last.t, {**last.data, "prediction_time": 99.0})
    assert "prediction_time is 99.0" in difference(shipped(), shipped()._replace(events=events), period=0.5)


def test_an_event_that_comes_too_late_is_noticed():
    late = [event.__class__(event.type, event.t + 0.7, event.data) for event in shipped().events]
    assert "off by 0.7 s" in difference(shipped(), shipped()._replace(events=late), period=0.5)
    assert difference(shipped(), shipped()._replace(events=late), period=0.8) == ""
