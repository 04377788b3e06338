"""How long movements last, as phases; which were probably misread, as the likeliest path says."""

import itertools
import math

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from low_level_kitchen import kitchen_rows, movements, rows_of

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.durations import MOST_PHASES, Duration, durations_text, fitted, read_durations
from casper.engine.actions.misread import logarithms
from casper.engine.actions.prediction import ActionSettings, Misread
from casper.engine.movements.movements import Movement
from casper.kb.errors import DomainError

ROWS = kitchen_rows()
NAMES = ("pick", "place", "still", "transport", "walk")


def with_durations(phases, seconds=6.0):
    facts = [(name, seconds, phases) for name in NAMES]
    return lambda name, arity: facts if (name, arity) == ("lasts", 3) else ROWS(name, arity)


def seen(recogniser, names, dt=1.0, **more):
    """What is recognised and accepted, and what was misread on the way to it."""
    found = []
    for at, name in enumerate(names, 1):
        prediction = recogniser.update(Movement(at * dt, name, **more))
        if prediction is not None:
            found.append((prediction.action, recogniser.misread()))
            recogniser.accept()
    return found


def slowly(letters, steps=4):
    return [name for name in movements(letters) for _ in range(steps)]


@given(st.floats(0.1, 20), st.integers(1, MOST_PHASES), st.floats(0, 30))
def test_phases_pass_one_after_the_other_and_never_more_than_all(mean, phases, dt):
    passed = Duration(mean, phases).passed(dt)
    assert len(passed) == phases and all(0 <= p <= 1 for p in passed) and sum(passed) <= 1 + 1e-9


@pytest.mark.parametrize("phases", [1, 2, 4])
def test_a_movement_of_phases_has_its_mean(phases):
    duration = Duration(6.0, phases)
    survival = [sum(duration.passed(dt / 100)) for dt in range(8000)]
    assert sum(survival) / 100 == pytest.approx(6.0, rel=0.01)


def test_more_phases_make_very_short_movements_rare():
    ended = [1 - sum(Duration(6.0, phases).passed(1.0)) for phases in (1, 2, 4)]
    assert ended[0] > 2 * ended[1] > 4 * ended[2]


@given(st.integers(1, MOST_PHASES), st.floats(0.1, 3), st.floats(0.1, 3))
def test_one_step_or_two_are_the_same(phases, one, other):
    duration = Duration(4.0, phases)
    first, second, both = duration.passed(one), duration.passed(other), duration.passed(one + other)
    added = [sum(first[k] * second[total - k] for k in range(total + 1)) for total in range(phases)]
    assert added == pytest.approx(list(both), abs=1e-12)


def test_one_phase_of_the_usual_length_is_what_there_is_without_facts():
    plain, told = (action_recogniser(rows, ActionSettings()) for rows in (ROWS, with_durations(1)))
    for at, name in enumerate(slowly("SWPTLPLPL"), 1):
        assert plain.update(Movement(float(at), name)) == told.update(Movement(float(at), name))
        assert plain.underway == told.underway


@pytest.mark.parametrize("phases", [2, 3, 6])
def test_actions_are_recognised_with_phases(phases):
    recogniser = action_recogniser(with_durations(phases), ActionSettings())
    assert [action for action, _ in seen(recogniser, slowly("SWPTLPLPL"))] == ["pick_and_place", "use"]


@settings(max_examples=20, deadline=None)
@given(st.lists(st.sampled_from(NAMES), max_size=25), st.integers(1, 4))
def test_belief_stays_one_with_any_number_of_phases(names, phases):
    recogniser = action_recogniser(with_durations(phases), ActionSettings())
    for at, name in enumerate(names):
        if recogniser.update(Movement(at * 0.5, name)) is not None and at % 2:
            recogniser.accept()
        assert sum(recogniser.underway.values()) == pytest.approx(1)


def test_durations_are_learned_from_how_long_movements_lasted():
    assert fitted([2.0, 2.0, 2.0]) == Duration(2.0, MOST_PHASES)
    assert fitted([1.0, 3.0]) == Duration(2.0, 4)
    assert fitted([0.1, 0.1, 9.0]).phases == 1


def test_learned_durations_are_facts_of_what_was_seen_often_and_of_three_phases_at_most():
    text = durations_text({"walk": [2.0] * 10, "still": [1.0] * 9})
    assert "lasts(walk, 2.0, 3)." in text and "still" not in text


@pytest.mark.parametrize(
    ("facts", "sentence"),
    [
        ([("fly", 2.0, 1)], "names a movement no transition has"),
        ([("walk", 0.0, 1)], "lasts longer than no time"),
        ([("walk", 2.0, 99)], "from 1 to 6 phases, not 99"),
        ([("walk", 2.0, 1.5)], "phases are counted"),
        ([("walk", 2.0, 1), ("walk", 3.0, 1)], "is there twice"),
    ],
)
def test_durations_that_are_none_are_refused(facts, sentence):
    with pytest.raises(DomainError, match=sentence):
        read_durations(rows_of({("lasts", 3): facts}), NAMES, 6.0)


# --- misread movements


def test_nothing_was_misread_where_everything_fits():
    assert seen(action_recogniser(ROWS, ActionSettings()), slowly("WPTL")) == [("pick_and_place", ())]


def test_a_step_that_was_misread_is_found_when_the_action_is_known():
    names = slowly("WPTL", 5)
    names[12] = "still"  # in the middle of the transport
    ((action, misread),) = seen(action_recogniser(ROWS, ActionSettings()), names)
    assert (action, misread) == ("pick_and_place", (Misread(13.0, "still", "transport"),))


def test_what_was_misread_before_an_action_is_not_told_of_the_next():
    names = slowly("WPTL", 5) + slowly("PLPL", 5)
    names[12] = "still"
    (_, first), (action, second) = seen(action_recogniser(ROWS, ActionSettings()), names)
    assert first and action == "use" and second == ()


def test_the_path_is_the_likeliest_of_all_paths():
    recogniser = action_recogniser(ROWS, ActionSettings())
    trail, model = recogniser._trail, recogniser._model
    observed = [(1.0, "transport"), (2.0, "walk"), (3.0, "place")]
    for t, name in observed:
        trail.add(t, name, logarithms({m: row[name] for m, row in recogniser._emission.items()}))
    arcs = [dict(row) for row in model.arcs]
    stay = math.exp(-1 / 6.0)

    def weight(path):
        first = max(p * (path[0] == i) for i, p in [*model.initial.items()])
        first = max(first, *(p * arcs[i].get(path[0], 0.0) for i, p in model.initial.items()))
        p = first * recogniser._emission[model.states[path[0]].movement]["transport"]
        for (a, b), (_, name) in zip(itertools.pairwise(path), observed[1:]):
            p *= max(stay * (a == b), (1 - stay) * arcs[a].get(b, 0.0)) * recogniser._emission[model.states[b].movement][name]
        return p

    ends = [i for i in range(len(model.states)) if model.complete[i] == "pick_and_place"]
    starts = range(len(model.states))
    best = max(weight((a, b, c)) for a in starts for b in (a, *arcs[a]) for c in ends)
    assert weight(tuple(trail._path("pick_and_place"))) == pytest.approx(best)


def test_learned_likelihoods_count_instead_of_the_emission():
    recogniser = action_recogniser(ROWS, ActionSettings())
    for t in range(1, 5):
        recogniser.update(Movement(float(t), "still", likelihoods={name: 0.9 if name == "walk" else 0.025 for name in NAMES}))
    believed = [(recogniser._model.states[key].movement, p) for key, p in recogniser._believed()]
    shares = {name: sum(p for movement, p in believed if movement == name) for name in NAMES}
    assert max(shares, key=shares.__getitem__) == "walk"
