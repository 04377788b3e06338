"""The robot's part in a lunch as a behaviour tree: it waits for the partner, then clears the plate.

Run it with: pip install 'casper-hri[behaviour-trees]' && python examples/behaviour_tree.py
"""

import py_trees

from casper import Domain
from casper.planning import behaviour_tree

SEEN = ["cook(meal, hobs)", "pick_and_place(meal, plate)", "eat(meal, plate)"]


def carry(thing: str, place: str) -> bool:
    """What would move the arm."""
    print(f"    (carrying the {thing} to the {place})")
    return True


class Wash(py_trees.behaviour.Behaviour):
    """Washing takes three ticks."""

    def initialise(self) -> None:
        """Nothing is washed yet."""
        self.ticks = 0

    def update(self) -> py_trees.common.Status:
        """A little cleaner with each tick."""
        self.ticks += 1
        return py_trees.common.Status.SUCCESS if self.ticks == 3 else py_trees.common.Status.RUNNING


def main() -> None:
    """Tick until the robot's part is done, while the partner goes on."""
    kitchen = Domain.load("kitchen")
    reading = kitchen.reading()
    reading.observe("pick_and_place(meal, hobs)")
    plan = reading.plan_for(kitchen.robot)
    assert plan is not None
    tree = behaviour_tree(plan, {"pick_and_place": carry, "wash": Wash}, kitchen, reading)
    seen = iter(SEEN)
    while True:
        tree.tick_once()
        print(py_trees.display.unicode_tree(tree, show_status=True))
        if tree.status != py_trees.common.Status.RUNNING:
            break
        step = next(seen, None)
        if step is not None:
            reading.observe(step)


if __name__ == "__main__":
    main()
