"""The stages together: a person walks to the biscuits, carries them to the plate, eats, under noise."""

import math
import random
import sys

import pytest
from low_level_kitchen import QDC, five_clauses, kitchen_rows

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.contexts import context_table, contextualise
from casper.engine.movements.movements import MovementClassifier
from casper.engine.perception.focus import FocusEstimator, focus_settings
from casper.engine.perception.perception import Perception, perception_settings
from casper.engine.perception.tracking import Tracker, tracker_settings
from casper.engine.perception.world import AgentState, ObjectState, WorldState

OBJECTS = {
    "sink": (-1.01, 1.33),
    "glass": (0.21, 1.13),
    "hobs": (1.59, 1.11),
    "biscuits": (1.61, -0.42),
    "meal": (1.67, -1.58),
    "plate": (-0.66, -1.15),
    "bottle": (-2.01, -3.37),
}


class Person:
    """A person who walks in straight lines, as a list of world states, one every ``dt`` seconds."""

    def __init__(self, noise=0.0, dropout=0.0, dt=0.5, seed=1):
        self.x, self.y, self.heading, self.holding, self.t = -1.92, -1.44, 0.0, None, 0.0
        self.objects, self.states = dict(OBJECTS), []
        self.noise, self.dropout, self.dt, self.source = noise, dropout, dt, random.Random(seed)

    def wait(self, seconds):
        for _ in range(round(seconds / self.dt)):
            self.look()

    def look(self):
        self.t += self.dt
        if self.holding:
            reach = (self.x + 0.3 * math.cos(self.heading), self.y + 0.3 * math.sin(self.heading))
            self.objects[self.holding] = reach

        def off():
            return self.source.gauss(0, self.noise)

        seen = {
            n: ObjectState(x + off(), y + off())
            for n, (x, y) in self.objects.items()
            if self.source.random() >= self.dropout
        }
        me = AgentState(self.x + off(), self.y + off(), self.heading, self.holding)
        self.states.append(WorldState(self.t, {"human": me}, seen))

    def walk_to(self, thing):
        x, y = self.objects[thing]
        self.heading = math.atan2(y - self.y, x - self.x)
        while (left := math.dist((x, y), (self.x, self.y)) - 0.57) > 0.01:
            way = min(0.8 * self.dt, left)
            self.x, self.y = self.x + way * math.cos(self.heading), self.y + way * math.sin(self.heading)
            self.look()

    def pick_and_place(self, thing, at):
        self.walk_to(thing)
        self.wait(3)
        self.holding = thing
        self.wait(1)
        self.walk_to(at)
        self.wait(3)
        self.objects[thing], self.holding = self.objects[at], None
        self.wait(2)

    def use(self, thing):
        for _ in range(3):
            self.wait(3)
            place, self.holding = self.objects[thing], thing
            self.wait(3)
            self.objects[thing], self.holding = place, None
        self.wait(2)


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
