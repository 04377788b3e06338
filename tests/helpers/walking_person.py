"""A person in the kitchen's places, as world states: walks, carries, uses, seen through noise and with gaps."""

import math
import random

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
    """A person who walks in straight lines, as a list of world states, one every ``dt`` seconds.

    Of the things a share is not seen (``dropout``) in each of them, and in a share the person is not (``hidden``).
    """

    def __init__(self, noise=0.0, dropout=0.0, dt=0.5, seed=1, hidden=0.0):
        self.x, self.y, self.heading, self.holding, self.t = -1.92, -1.44, 0.0, None, 0.0
        self.objects, self.states = dict(OBJECTS), []
        self.noise, self.dropout, self.hidden, self.dt = noise, dropout, hidden, dt
        self.source, self.gaps = random.Random(seed), random.Random(seed + 1)

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
        in_view = self.hidden == 0.0 or self.gaps.random() >= self.hidden
        self.states.append(WorldState(self.t, {"human": me} if in_view else {}, seen))

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
