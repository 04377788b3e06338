"""The kitchen's lunch as a problem of Unified Planning, with what its plans do not say: only a clean plate is used."""

from typing import Any

THINGS = ("meal", "biscuits", "plate", "sink", "hobs")
FITS = (("meal", "hobs"), ("meal", "plate"), ("biscuits", "plate"), ("plate", "sink"))


def lunch_problem(dirty: bool = False, agents: bool = False, can_wash: bool = True) -> Any:
    """Eat the meal, and have a clean plate.

    Args:
        dirty: the plate is dirty at first.
        agents: every action says who does it, human or tiago; only the human eats.
        can_wash: there is water in the sink.
    """
    from unified_planning.shortcuts import Fluent, InstantaneousAction, Problem, UserType

    thing, agent = UserType("thing"), UserType("agent")
    problem = Problem("lunch")
    fits, on = (Fluent(name, i=thing, d=thing) for name in ("fits", "on"))
    clean, hot, wet, dish = (Fluent(name, i=thing) for name in ("clean", "hot", "wet", "dish"))
    cooked, eaten = (Fluent(name, i=thing) for name in ("cooked", "eaten"))
    person = Fluent("person", a=agent)
    for fluent in (fits, on, clean, hot, wet, dish, cooked, eaten, *([person] if agents else [])):
        problem.add_fluent(fluent, default_initial_value=False)
    known = {name: problem.add_object(name, thing) for name in THINGS}

    def action(name: str, needs: Any, makes: Any, ends: Any = lambda i, d: ()) -> Any:
        who = {"a": agent} if agents else {}
        made = InstantaneousAction(name, **who, i=thing, d=thing)
        i, d = made.parameter("i"), made.parameter("d")
        for fact in needs(i, d):
            made.add_precondition(fact)
        if agents and name == "eat":
            made.add_precondition(person(made.parameter("a")))
        for fact in makes(i, d):
            made.add_effect(fact, True)
        for fact in ends(i, d):
            made.add_effect(fact, False)
        problem.add_action(made)

    action("pick_and_place", lambda i, d: (fits(i, d), clean(d)), lambda i, d: (on(i, d),))
    action("cook", lambda i, d: (on(i, d), hot(d)), lambda i, d: (cooked(i),))
    action(
        "eat",
        lambda i, d: (on(i, d), cooked(i), dish(d)),
        lambda i, d: (eaten(i),),
        lambda i, d: (clean(d), on(d, known["sink"])),
    )
    action("wash", lambda i, d: (on(i, d), wet(d)), lambda i, d: (clean(i),))
    for one, other in FITS:
        problem.set_initial_value(fits(known[one], known[other]), True)
    for name in ("hobs", "sink") if dirty else ("hobs", "sink", "plate"):
        problem.set_initial_value(clean(known[name]), True)
    problem.set_initial_value(dish(known["plate"]), True)
    problem.set_initial_value(hot(known["hobs"]), True)
    if can_wash:
        problem.set_initial_value(wet(known["sink"]), True)
    if agents:
        people = {name: problem.add_object(name, agent) for name in ("human", "tiago")}
        problem.set_initial_value(person(people["human"]), True)
    problem.add_goal(eaten(known["meal"]))
    problem.add_goal(clean(known["plate"]))
    return problem
