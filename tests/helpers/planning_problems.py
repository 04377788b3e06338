"""Problems of planning in the manner of the competition's hierarchical domains, made up: vehicles that carry packages
over roads, with fuel, odd conditions, conditional effects, and recursive methods in any order.

Everything is drawn, so hypothesis shrinks a problem that fails to a small one.
"""

from collections.abc import Callable
from typing import Any

from hypothesis import strategies as st
from unified_planning.model import Variable
from unified_planning.model.htn import HierarchicalProblem, Method
from unified_planning.shortcuts import (
    GE,
    LT,
    Action,
    And,
    Equals,
    Exists,
    Fluent,
    Forall,
    Iff,
    Implies,
    InstantaneousAction,
    Int,
    IntType,
    Not,
    Object,
    Or,
    Problem,
    UserType,
)

THING = UserType("thing")
PLACE, MOVABLE = UserType("place"), UserType("movable", THING)
VEHICLE, PACKAGE = UserType("vehicle", MOVABLE), UserType("package", MOVABLE)
AT, ROAD = Fluent("at", x=MOVABLE, where=PLACE), Fluent("road", a=PLACE, b=PLACE)
IN, HEAVY = Fluent("in", p=PACKAGE, v=VEHICLE), Fluent("heavy", p=PACKAGE)
FUEL, HOME = Fluent("fuel", IntType(), v=VEHICLE), Fluent("home", PLACE, v=VEHICLE)


class Made:
    """A problem that is being drawn."""

    def __init__(self, draw: Callable[[st.SearchStrategy[Any]], Any], hierarchical: bool) -> None:
        self.draw = draw
        self.problem: Any = HierarchicalProblem("made-up") if hierarchical else Problem("made-up")
        for fluent in (AT, ROAD, IN, HEAVY):
            self.problem.add_fluent(fluent, default_initial_value=False)
        for fluent in (FUEL, HOME):
            self.problem.add_fluent(fluent)
        self.places = self._objects("place", PLACE, 2, 3)
        self.vehicles = self._objects("truck-", VEHICLE, 1, 2)
        self.packages = self._objects("p", PACKAGE, 1, 2)

    def _objects(self, name: str, kind: Any, least: int, most: int) -> list[Any]:
        made = [Object(f"{name}{number}", kind) for number in range(self.draw(st.integers(least, most)))]
        self.problem.add_objects(made)
        return made

    def initial(self) -> None:
        """A first state."""
        for a in self.places:
            for b in self.places:
                if a != b and self.draw(st.booleans()):
                    self.problem.set_initial_value(ROAD(a, b), True)
        for each in (*self.vehicles, *self.packages):
            self.problem.set_initial_value(AT(each, self.draw(st.sampled_from(self.places))), True)
        for vehicle in self.vehicles:
            self.problem.set_initial_value(FUEL(vehicle), self.draw(st.integers(0, 3)))
            self.problem.set_initial_value(HOME(vehicle), self.draw(st.sampled_from(self.places)))

    def condition(self, things: dict[Any, list[Any]], depth: int = 2) -> Any:
        """A condition on what there is of each type."""
        kind = self.draw(st.sampled_from(_ATOMS if not depth else _ATOMS + _FORMS))
        below = depth - 1
        if kind in _FORMS[:5]:
            one, other = self.condition(things, below), self.condition(things, below)
            return {"and": And, "or": Or, "implies": Implies, "iff": Iff}.get(kind, lambda a, b: Not(a))(one, other)
        if kind in ("exists", "forall"):
            of = self.draw(st.sampled_from([PLACE, VEHICLE, PACKAGE]))
            bound = Variable(self.draw(st.sampled_from(["x", "y"])), of)
            inner = self.condition({**things, of: [*things.get(of, []), bound]}, below)
            return (Exists if kind == "exists" else Forall)(inner, bound)
        return self._atom(kind, things)

    def _atom(self, kind: str, things: dict[Any, list[Any]]) -> Any:
        def one(of: Any, otherwise: list[Any]) -> Any:
            return self.draw(st.sampled_from(things.get(of) or otherwise))

        place, vehicle, package = (
            one(of, others) for of, others in ((PLACE, self.places), (VEHICLE, self.vehicles), (PACKAGE, self.packages))
        )
        return {
            "at": lambda: AT(self.draw(st.sampled_from([vehicle, package])), place),
            "road": lambda: ROAD(place, one(PLACE, self.places)),
            "in": lambda: IN(package, vehicle),
            "heavy": lambda: HEAVY(package),
            "same": lambda: Equals(place, one(PLACE, self.places)),
            "fuel": lambda: GE(FUEL(vehicle), Int(self.draw(st.integers(0, 3)))),
            "less": lambda: LT(FUEL(vehicle), FUEL(one(VEHICLE, self.vehicles)) + 1),
            "home": lambda: Equals(HOME(vehicle), place),
            "at home": lambda: AT(vehicle, HOME(vehicle)),
        }[kind]()

    def actions(self) -> list[Action]:
        """Driving, loading and unloading, each with something odd."""
        drive = InstantaneousAction("drive", v=VEHICLE, a=PLACE, b=PLACE)
        v, a, b = drive.parameters
        drive.add_precondition(And(AT(v, a), Not(Equals(a, b))))
        drive.add_effect(AT(v, a), False)
        drive.add_effect(AT(v, b), True)
        self._odd(drive, {PLACE: [a, b], VEHICLE: [v]})
        if self.draw(st.booleans()):
            drive.add_decrease_effect(FUEL(v), 1)
        load = InstantaneousAction("load-it", p=PACKAGE, v=VEHICLE, where=PLACE)
        p, v, where = load.parameters
        load.add_precondition(And(AT(v, where), AT(p, where)))
        load.add_effect(AT(p, where), False)
        load.add_effect(IN(p, v), True)
        self._odd(load, {PLACE: [where], VEHICLE: [v], PACKAGE: [p]})
        goal = InstantaneousAction("goal", v=VEHICLE, where=PLACE)  # a name that has a meaning to the system
        v, where = goal.parameters
        goal.add_effect(HOME(v), where, self.condition({PLACE: [where], VEHICLE: [v]}, 1))
        package = Variable("p", PACKAGE)
        goal.add_effect(AT(package, where), True, IN(package, v), forall=[package])
        goal.add_effect(IN(package, v), False, And(IN(package, v), Not(HEAVY(package))), forall=[package])
        self.problem.add_actions([drive, load, goal])
        return [drive, load, goal]

    def _odd(self, action: Any, things: dict[Any, list[Any]]) -> None:
        for _ in range(self.draw(st.integers(0, 2))):
            action.add_precondition(self.condition(things))
        if PACKAGE in things and self.draw(st.booleans()):
            value = self.draw(st.booleans())
            action.add_effect(HEAVY(things[PACKAGE][0]), value, self.condition(things, 1))

    def hierarchy(self, drive: Any, load: Any, unload: Any) -> None:
        """Deliver by going there, recursively or not, in a total, a partial or no order."""
        problem = self.problem
        deliver = problem.add_task("deliver", p=PACKAGE, where=PLACE)
        go = problem.add_task("go-to", v=VEHICLE, where=PLACE)
        there = Method("m-there", v=VEHICLE, where=PLACE)
        there.set_task(go, *there.parameters)
        there.add_precondition(AT(there.parameter("v"), there.parameter("where")))
        via = Method("m-via", v=VEHICLE, where=PLACE, via=PLACE)
        via.set_task(go, via.parameter("v"), via.parameter("where"))
        if self.draw(st.booleans()):
            via.add_constraint(Not(Equals(via.parameter("via"), via.parameter("where"))))
        first = via.add_subtask(go, via.parameter("v"), via.parameter("via"))
        second = via.add_subtask(drive, via.parameter("v"), via.parameter("via"), via.parameter("where"))
        via.set_ordered(first, second)
        carry = Method("m-carry", p=PACKAGE, where=PLACE, v=VEHICLE, a=PLACE)
        carry.set_task(deliver, carry.parameter("p"), carry.parameter("where"))
        p, where, v, a = carry.parameters
        carry.add_precondition(self.condition({PACKAGE: [p], PLACE: [where, a], VEHICLE: [v]}))
        steps = [carry.add_subtask(*each) for each in ((go, v, a), (load, p, v, a), (go, v, where), (unload, v, where))]
        self._order(carry, steps)
        methods = self.draw(st.permutations([there, via, carry]))
        for method in methods:
            problem.add_method(method)
        network = problem.task_network
        target = self.draw(st.sampled_from(self.places))
        tasks = [network.add_subtask(deliver, package, target) for package in self.packages]
        if self.draw(st.booleans()):
            free = network.add_variable("somewhere", PLACE)
            network.add_constraint(Or(Equals(free, self.places[0]), Not(Equals(free, self.places[1]))))
            tasks.append(network.add_subtask(go, self.vehicles[0], free))
        self._order(network, tasks)

    def _order(self, network: Any, steps: list[Any]) -> None:
        kind = self.draw(st.sampled_from(["total", "partial", "none"]))
        if kind == "total":
            network.set_ordered(*steps)
        elif kind == "partial":
            steps = self.draw(st.permutations(steps))  # what comes first need not be written first
            for at, one in enumerate(steps):
                for other in steps[at + 1 :]:
                    if self.draw(st.booleans()):
                        network.set_strictly_before(one, other)


_ATOMS = ["at", "road", "in", "heavy", "same", "fuel", "less", "home", "at home"]
_FORMS = ["and", "or", "implies", "iff", "not", "exists", "forall"]


@st.composite
def problems(draw: Callable[[st.SearchStrategy[Any]], Any], hierarchical: bool = False) -> Any:
    """A problem, with tasks and methods or with a state that is wanted."""
    made = Made(draw, hierarchical)
    made.initial()
    actions = made.actions()
    if hierarchical:
        made.hierarchy(*actions)
    if not hierarchical or draw(st.booleans()):
        made.problem.add_goal(made.condition({}))
    return made.problem
