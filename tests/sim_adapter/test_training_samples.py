"""Samples to learn from: one simulated trial, seen through several eyes at once."""

import pytest

from casper import Domain
from casper.engine.movements.features import TimedFeatures
from casper.kb.errors import DomainError

pytest.importorskip("mujoco")

from casper.sim_adapter.training.samples import MANY, OWN, Eye, training_samples

KITCHEN = Domain.load("kitchen")


@pytest.fixture(scope="module")
def samples():
    eyes = (OWN, Eye(0.06, 1.0))
    return list(training_samples(KITCHEN, 2, 1, eyes=eyes, kind=TimedFeatures, uses=True))


def test_a_trial_is_seen_through_every_eye_at_its_rate(samples):
    counts = {level: sum(s.level == level and s.trial == 0 for s in samples) for level in {s.level for s in samples}}
    assert counts.keys() == {"1 cm, 0.5 s", "6 cm, 1 s"}
    assert 30 < counts["1 cm, 0.5 s"] < 60


def test_all_movements_are_made_and_every_other_trial_has_a_use(samples):
    assert {s.label for s in samples} == {"still", "walk", "transport", "pick", "place"}
    places = [sum(s.label == "place" for s in samples if s.trial == trial and s.level.startswith("1 ")) for trial in (0, 1)]
    assert places[1] > 2 * places[0]


def test_a_poor_eye_is_filtered_as_in_a_mind(samples):
    assert {s.features.eye for s in samples if s.level == "1 cm, 0.5 s"} == {"plain"}
    poor = [s.features.eye for s in samples if s.level == "6 cm, 1 s"]
    assert poor.count("filtered") > 0.8 * len(poor)


def test_the_same_seed_gives_the_same_samples():
    one, other = (list(training_samples(KITCHEN, 1, 3)) for _ in range(2))
    assert one == other and {s.level for s in one} == {""}


@pytest.mark.parametrize("wrong", [{"noise": -0.1}, {"noise": float("nan")}, {"period": 0.01}, {"period": float("inf")}])
def test_an_eye_that_is_none_is_refused(wrong):
    with pytest.raises(DomainError):
        Eye(**wrong)


def test_many_eyes_have_names_of_their_own():
    from casper.sim_adapter.room.facts import scene_of

    assert len({eye.named(scene_of(KITCHEN)) for eye in MANY}) == len(MANY) == 12
