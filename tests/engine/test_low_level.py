"""The stages together: a person walks to the biscuits, carries them to the plate, eats, under noise."""

import sys

import pytest
from low_level_kitchen import QDC, five_clauses, kitchen_rows
from walking_person import Person

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.contexts import context_table, contextualise
from casper.engine.movements.movements import MovementClassifier
from casper.engine.perception.focus import FocusEstimator, focus_settings
from casper.engine.perception.perception import Perception, perception_settings
from casper.engine.perception.tracking import Tracker, tracker_settings


def statements(states):
    """What a robot makes of it: contextualised action, target, destination."""
    rows = kitchen_rows()
    tracker, perception = Tracker(tracker_settings(rows)), Perception(perception_settings(rows), "human")
    focus, classifier = FocusEstimator(focus_settings(rows)), MovementClassifier(five_clauses(), QDC)
    recogniser, contexts = action_recogniser(rows), context_table(rows)
    found = []
    for world in states:
        relations = perception.update(tracker.update(world))
        attention = focus.update(relations)
        prediction = recogniser.update(classifier.update(relations, attention))
        if prediction is None:
            continue
        action = contextualise(prediction.action, attention.destination, contexts)
        if action is not None:
            recogniser.accept()
            found.append((action, attention.target, attention.destination))
    return [statement for statement in found if statement[0] != "relocate"]


@pytest.mark.parametrize(("noise", "dropout"), [(0.0, 0.0), (0.02, 0.0), (0.02, 0.1)])
def test_a_breakfast_is_read_from_positions_alone(noise, dropout):
    person = Person(noise, dropout)
    person.wait(4)
    person.pick_and_place("biscuits", "plate")
    person.use("biscuits")
    person.pick_and_place("plate", "sink")
    person.use("plate")
    assert statements(person.states) == [
        ("pick_and_place", "biscuits", "plate"),
        ("eat", "biscuits", "plate"),
        ("pick_and_place", "plate", "sink"),
        ("wash", "plate", "sink"),
    ]


def test_reading_a_person_needs_no_heavy_library():
    import subprocess

    code = (
        "import sys\n"
        "import casper.engine.actions.actions, casper.engine.perception.focus, casper.engine.actions.hmm, casper.engine.movements.movements\n"
        "import casper.engine.perception.perception, casper.engine.actions.ratcliff, casper.engine.perception.tracking, casper.engine.movements.tree\n"
        "print([name for name in ('numpy', 'sklearn', 'mujoco', 'matplotlib') if name in sys.modules])"
    )
    assert subprocess.run([sys.executable, "-c", code], capture_output=True, text=True).stdout.strip() == "[]"
