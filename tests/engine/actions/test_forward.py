import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from low_level_kitchen import kitchen_rows

from casper.engine.actions.durations import Duration
from casper.engine.actions.forward import Forward, step
from casper.engine.actions.fsm import movements_of, read_fsms
from casper.engine.actions.hmm_model import HmmModel
from casper.engine.actions.prediction import ActionSettings

FSMS = read_fsms(kitchen_rows())
MOVEMENTS = movements_of(FSMS)
MODELS = [HmmModel(ActionSettings(), FSMS, keeps) for keeps in (frozenset(), frozenset({"use", "pick_and_place"}))]

durations = st.lists(
    st.builds(Duration, st.floats(0.5, 20.0), st.integers(1, 4)), min_size=len(MOVEMENTS), max_size=len(MOVEMENTS)
).map(lambda each: dict(zip(MOVEMENTS, each)))
likelihoods = st.fixed_dictionaries(dict.fromkeys(MOVEMENTS, st.floats(1e-3, 1.0)))
steps = st.lists(st.tuples(st.sampled_from((0.0, 0.1, 0.5, 3.0)), likelihoods), min_size=1, max_size=8)


@settings(max_examples=60)
@given(st.sampled_from(MODELS), durations, steps)
def test_steps_on_lists_are_those_arc_by_arc(model, lasting, seen):
    forward = Forward(model, lasting)
    plain = {index * forward.phases: p for index, p in model.initial.items()}
    belief = forward.belief(plain)
    for dt, likelihood in seen:
        plain, belief = step(model, lasting, plain, dt, likelihood), forward.step(belief, dt, forward.weights(likelihood))
        assert belief == pytest.approx([plain.get(key, 0.0) for key in range(len(belief))], abs=1e-12)
        assert sum(belief) == pytest.approx(1.0, abs=1e-4)


@settings(max_examples=20)
@given(st.sampled_from(MODELS), durations, steps)
def test_what_happened_and_what_is_going_on_are_sums_over_states(model, lasting, seen):
    forward = Forward(model, lasting)
    belief = forward.belief({index * forward.phases: p for index, p in model.initial.items()})
    for dt, likelihood in seen:
        belief = forward.step(belief, dt, forward.weights(likelihood))
    phases = forward.phases
    by_state = [sum(belief[key : key + phases]) for key in range(0, len(belief), phases)]
    for action in ("use", "pick_and_place", "relocate"):
        done = [p for p, complete in zip(by_state, model.complete) if complete == action]
        going = [p for p, state in zip(by_state, model.states) if state.action == action and state.progress >= 0]
        assert forward.happened(belief)[action] == pytest.approx(sum(done))
        assert forward.underway(belief)[action] == pytest.approx(sum(going))
    assert sum(forward.underway(belief).values()) == pytest.approx(sum(belief))


def test_what_states_have_in_common_and_what_they_have_alone_are_their_arcs():
    for model in MODELS:
        for arcs, change in zip(model.arcs, model.changes):
            found = dict(change.own)
            for to, p in model.afresh.get(change.afresh, ()):
                found[to] = found.get(to, 0.0) + change.new * p
            assert {to: p for to, p in found.items() if p} == pytest.approx(dict(arcs))


def test_times_between_steps_do_not_pile_up():
    forward = Forward(MODELS[0], {name: Duration(6.0) for name in MOVEMENTS})
    belief = forward.belief(MODELS[0].initial)
    for n in range(1000):
        belief = forward.expected(belief, 0.1 + n * 1e-6)
    assert len(forward._tables) <= 64
