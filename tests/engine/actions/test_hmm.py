import itertools

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from low_level_kitchen import kitchen_rows, movements, rows_of

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.comparison import compare_recognisers, completion, simulate
from casper.engine.actions.fsm import movements_of, read_fsms
from casper.engine.actions.hmm import HmmRecogniser, read_emission
from casper.engine.actions.prediction import ActionSettings
from casper.engine.movements.movements import Movement
from casper.kb.errors import DomainError

ROWS = kitchen_rows()
FSMS = read_fsms(ROWS)
BREAKFAST = ("S", "WPTL", "PLPLPL", "PTL", "PLPLPL", "PWS")
ACTIONS = (None, "pick_and_place", "use", "pick_and_place", "use", None)
SCRIPT = [(action, movements(letters)) for action, letters in zip(ACTIONS, BREAKFAST, strict=True)]


def hmm(**changed):
    return action_recogniser(ROWS, ActionSettings(**changed))


def accepted(recogniser, letters, steps=4, dt=1.0):
    """What is recognised and accepted, as (which movement of the letters was going on, action)."""
    found, t = [], 0.0
    for number, name in enumerate(movements(letters)):
        for _ in range(steps):
            t += dt
            prediction = recogniser.update(Movement(t, name))
            if prediction is not None:
                found.append((number, prediction.action))
                recogniser.accept()
    return found


def test_pick_and_place_is_recognised_at_its_place_and_not_before():
    assert accepted(hmm(), "SWPTL") == [(4, "pick_and_place")]
    assert accepted(hmm(), "SWPT") == []


def test_use_is_recognised_at_the_second_place():
    assert accepted(hmm(), "SWPLPLPL") == [(5, "use")]
    assert accepted(hmm(), "SWPLP") == []


def test_a_pick_that_was_overlooked_does_not_matter_to_who_sees_the_transport():
    assert accepted(hmm(), "SWTL") == [(3, "pick_and_place")]


def test_going_round_a_loop_again_is_the_same_action():
    assert accepted(hmm(), "WPLPLPLPLPL") == [(4, "use")]


def test_actions_on_end_are_each_recognised_once_and_in_order():
    found = [action for _, action in accepted(hmm(), "S WPTL PLPLPL PTL PLPLPL PWS")]
    assert found[:4] == ["pick_and_place", "use", "pick_and_place", "use"]
    assert set(found[4:]) <= {"relocate"}


@pytest.mark.parametrize(("steps", "dt"), [(8, 0.5), (16, 0.25)])
def test_how_often_one_looks_does_not_change_what_one_recognises(steps, dt):
    assert accepted(hmm(), "SWPTLPLPL", steps, dt) == accepted(hmm(), "SWPTLPLPL")


def test_one_misread_step_does_not_decide():
    recogniser, t = hmm(), 0.0
    for name in movements("SSSS WWWW PPPP TTT L TTT"):
        t += 1
        assert recogniser.update(Movement(t, name)) is None


def test_a_prediction_that_is_not_accepted_stands_and_is_fresh_once():
    recogniser = hmm()
    said = [recogniser.update(Movement(float(t), name)) for t, name in enumerate(movements("WWWPPPTTTLLLL"))]
    fresh = [p.fresh for p in said if p is not None]
    assert len(fresh) >= 2 and fresh == [True] + [False] * (len(fresh) - 1)


def test_after_an_unaccepted_pick_and_place_the_next_needs_its_own_place():
    recogniser, t, said = hmm(), 0.0, []
    for number, name in enumerate(movements("SWPTLPTL")):
        for _ in range(4):
            t += 1
            if (prediction := recogniser.update(Movement(t, name))) is not None:
                said.append((number, prediction.action))
    assert set(said) == {(4, "pick_and_place"), (7, "pick_and_place")}


@settings(max_examples=40)
@given(st.lists(st.sampled_from(movements("SWTPL")), max_size=40))
def test_probabilities_stay_probabilities_whatever_is_seen(names):
    recogniser = hmm()
    for t, name in enumerate(names):
        if recogniser.update(Movement(float(t), name)) is not None and t % 2:
            recogniser.accept()
        assert sum(recogniser.underway.values()) == pytest.approx(1)
        assert all(0 <= score <= 1 + 1e-9 for score in recogniser.scores.values())


def test_the_forward_algorithm_agrees_with_adding_up_every_path():
    tiny = ActionSettings(lasts=2.0, filter_window=1)
    fsms = FSMS[:1]
    emission = read_emission(rows_of({}), movements_of(fsms), 0.2)
    recogniser = HmmRecogniser(tiny, fsms, emission)
    names = movements("PTL")
    for t, name in enumerate(names):
        recogniser.update(Movement(float(t), name))
    model, stay = recogniser._model, 2.718281828459045 ** (-1 / 2.0)
    weight, complete = 0.0, 0.0
    arcs = [dict(row) for row in model.arcs]
    for path in itertools.product(range(len(model.states)), repeat=3):
        p = model.initial.get(path[0], 0.0)
        for a, b in itertools.pairwise(path):
            p *= stay * (a == b) + (1 - stay) * arcs[a].get(b, 0.0)
        for index, name in zip(path, names, strict=True):
            p *= emission[model.states[index].movement][name]
        weight += p
        complete += p * (model.complete[path[-1]] is not None)
    assert recogniser.scores["pick_and_place"] == pytest.approx(complete / weight, abs=1e-4)


def test_every_state_leads_somewhere_with_probability_one():
    model = hmm()._model
    assert sum(model.initial.values()) == pytest.approx(1)
    assert all(sum(p for _, p in row) == pytest.approx(1) for row in model.arcs)


# --- emission


def test_without_emission_facts_the_error_is_spread_evenly():
    row = read_emission(rows_of({}), movements_of(FSMS), 0.2)["walk"]
    assert row["walk"] == pytest.approx(0.8) and row["still"] == pytest.approx(0.05)


def test_an_emission_table_is_taken_from_the_facts_and_rules_nothing_out():
    facts = [(m, m, 1.0) for m in movements_of(FSMS)]
    row = read_emission(rows_of({("emission", 3): facts}), movements_of(FSMS), 0.2)["walk"]
    assert row["walk"] == 1.0 and 0 < row["still"] < 0.01


@pytest.mark.parametrize(
    ("facts", "sentence"),
    [
        ([("walk", "walk", 1)], "emission.still, …. adds up to 0"),
        ([("fly", "walk", 1)], "names a movement no transition"),
    ],
)
def test_an_emission_table_with_a_mistake_is_refused(facts, sentence):
    with pytest.raises(DomainError, match=sentence):
        read_emission(rows_of({("emission", 3): facts}), movements_of(FSMS), 0.2)


def test_a_movement_nobody_knows_is_refused():
    with pytest.raises(DomainError, match="knows the movement fly"):
        hmm().update(Movement(0.0, "fly"))


def test_an_action_without_a_cycle_is_refused():
    rows = rows_of({("transition", 4): [("a", "x", "y", 1), ("a", "y", "x", 1)]})
    with pytest.raises(DomainError, match="a needs cycle"):
        action_recogniser(rows, ActionSettings())


def test_without_any_action_there_is_nothing_to_recognise():
    with pytest.raises(DomainError, match="no action has transitions"):
        action_recogniser(rows_of({}), ActionSettings())


# --- against the paper's recogniser


@pytest.mark.parametrize("error", [0.06, 0.15])
def test_the_hmm_recognises_at_least_as_many_actions_rightly_as_ratcliff(error):
    both = {"hmm": hmm(), "ratcliff": hmm(recogniser="ratcliff")}
    found = compare_recognisers(both, [SCRIPT], FSMS, error=error, days=25, ignored=frozenset({"relocate"}))
    assert found["hmm"].actions == 100 == found["ratcliff"].actions
    assert found["hmm"].right >= found["ratcliff"].right
    assert found["hmm"].early <= found["ratcliff"].early
    assert found["hmm"].faultless >= found["ratcliff"].faultless


def test_without_error_both_recognise_every_action_of_the_day():
    both = {"hmm": hmm(), "ratcliff": hmm(recogniser="ratcliff")}
    found = compare_recognisers(both, [SCRIPT], FSMS, error=0.0, days=5, ignored=frozenset({"relocate"}))
    assert [(tally.right, tally.early, tally.extra) for tally in found.values()] == [(20, 0, 0), (20, 0, 0)]


def test_a_made_up_day_has_the_scripts_movements_and_so_many_errors():
    import random

    steps = simulate(SCRIPT, FSMS, 0.1, random.Random(2), lasts=(20, 20))
    true = [name for name, _ in itertools.groupby(step.true for step in steps)]
    assert true == movements("".join(BREAKFAST))
    wrong = sum(step.true != step.seen for step in steps) / len(steps)
    assert 0.06 < wrong < 0.14
    assert [step.finished for step in steps if step.finished] == [action for action in ACTIONS if action]


def test_an_action_is_finished_by_the_movement_that_completes_its_cycle():
    by_name = {fsm.action: fsm for fsm in FSMS}
    assert completion(by_name["use"], movements("PLPLPL")) == 3
    assert completion(by_name["pick_and_place"], movements("WPTL")) == 3
