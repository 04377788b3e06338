"""Recognisers before they have seen anything, and after they were told to begin anew."""

import pytest
from low_level_kitchen import kitchen_rows, movements, rows_of

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.fsm import movements_of, read_fsms
from casper.engine.actions.hmm import read_emission
from casper.engine.actions.prediction import ActionSettings, action_settings
from casper.engine.movements.movements import Movement
from casper.kb.errors import DomainError

ROWS = kitchen_rows()
NAMES = ("pick_and_place", "use", "relocate")


@pytest.fixture(params=["hmm", "ratcliff"])
def recogniser(request):
    return action_recogniser(ROWS, ActionSettings(recogniser=request.param))


def fed(recogniser, letters, steps=4):
    said = [recogniser.update(Movement(float(t), name)) for t, name in enumerate(n for n in movements(letters) for _ in range(steps))]
    return [prediction for prediction in said if prediction is not None]


def test_nothing_has_happened_before_anything_was_seen():
    fresh = action_recogniser(ROWS, ActionSettings())
    assert set(fresh.scores) == set(NAMES)
    assert set(fresh.scores.values()) == {0.0}
    assert fresh.window == ()
    assert fresh.underway[None] > 0 and sum(fresh.underway.values()) == pytest.approx(1.0)


def test_a_prediction_tells_its_time_its_score_and_the_movements_before_it(recogniser):
    first = fed(recogniser, "SWPTL")[0]
    assert first.action == "pick_and_place" and first.fresh
    assert first.score == first.scores["pick_and_place"] == max(first.scores.values())
    assert first.movements == tuple(movements("SWPTL"))[: len(first.movements)] == recogniser.window[: len(first.movements)]
    assert 16.0 <= first.t < 20.0


def test_what_was_accepted_begins_anew(recogniser):
    fed(recogniser, "SWPTL")
    recogniser.accept()
    assert recogniser.window == ()
    assert len(set(recogniser.scores.values())) == 1


def test_a_recogniser_that_was_reset_says_the_same_again(recogniser):
    first = fed(recogniser, "SWPTL")
    recogniser.reset()
    assert recogniser.window == ()
    assert fed(recogniser, "SWPTL") == first


@pytest.mark.parametrize(
    ("settings", "sentence"),
    [
        ({"recogniser": "guess"}, "recogniser is hmm or ratcliff, not guess"),
        ({"mode": "x"}, "mode is argmax, sample or mean"),
        ({"letters": "x"}, "letters is own or first"),
        ({"confirm": 0}, "start at 1"),
        ({"length": 0}, "start at 1"),
        ({"filter_window": 0}, "start at 1"),
        ({"threshold": 1.1}, "threshold of the actions lies between 0 and 1"),
        ({"again": -0.1}, "again of the actions lies between 0 and 1"),
        ({"lasts": 0.0}, "above 0"),
        ({"error": 0.0}, "above 0"),
    ],
)
def test_settings_out_of_bounds_are_refused(settings, sentence):
    with pytest.raises(DomainError, match=sentence):
        ActionSettings(**settings)


def test_settings_at_their_bounds_are_allowed():
    edge = {"threshold": 1.0, "certainty": 0.0, "error": 1.0, "idle": 0.0, "abandon": 1.0, "again": 0.0}
    assert ActionSettings(**edge, confirm=1, length=1, samples=1, filter_window=1).again == 0.0
    assert action_settings(rows_of({("setting", 3): [("actions", "confirm", 3), ("focus", "x", 1)]})).confirm == 3


@pytest.mark.parametrize(("total", "is_refused"), [(0.985, False), (1.015, False), (0.97, True), (1.03, True)])
def test_a_row_of_emissions_adds_up_to_one_within_rounding(total, is_refused):
    names = movements_of(read_fsms(ROWS))
    facts = [(name, name, total) for name in names]
    if is_refused:
        with pytest.raises(DomainError, match="adds up to"):
            read_emission(rows_of({("emission", 3): facts}), names, 0.1)
    else:
        table = read_emission(rows_of({("emission", 3): facts}), names, 0.1)
        assert table[names[0]][names[0]] == total and table[names[0]][names[1]] == 0.001
