"""Where the library's plan is blocked, a planner finds the rest, and the robot gets what it can do of it."""

import pytest

pytest.importorskip("unified_planning", reason="planning needs: pip install 'casper-hri[planning]'")

from lunch_problem import lunch_problem
from unified_planning.environment import get_environment

from casper import Domain
from casper.kb.errors import CasperError
from casper.planning import from_problem, remainder

PLANNERS = {"pyperplan": "Pyperplan", "fast-downward": "Fast Downward", "aries": "aries"}


@pytest.fixture(scope="module")
def kitchen():
    return Domain.load("kitchen")


def seen(domain, *actions):
    reading = domain.reading()
    for action in actions:
        reading.observe(action)
    return reading


@pytest.fixture(params=PLANNERS)
def planner(request):
    if request.param not in get_environment().factory.engines:
        pytest.skip(f"{request.param} is not installed: pip install up-{request.param}")
    return request.param


@pytest.mark.parametrize("agents", [False, True])
def test_each_planner_finds_the_rest_of_a_blocked_lunch(kitchen, planner, agents):
    rest = remainder(seen(kitchen, "pick_and_place(meal, hobs)"), lunch_problem(dirty=True, agents=agents), planner)
    done = [str(action) for action in rest.actions]
    assert {"pick_and_place(plate, sink)", "wash(plate, sink)", "cook(meal, hobs)"} <= set(done)
    assert done.index("pick_and_place(plate, sink)") < done.index("wash(plate, sink)")
    assert "eat(meal, plate)" not in done  # tiago does not eat
    assert rest.planner == PLANNERS[planner]
    assert "nothing makes clean(plate) hold" in rest.reason
    assert str(rest).splitlines()[-1].startswith(f"found by {PLANNERS[planner]}, because step 3, pick_and_place(meal, plate)")


def test_without_a_name_the_first_planner_that_can_is_asked(kitchen):
    assert remainder(seen(kitchen, "pick_and_place(meal, hobs)"), lunch_problem(dirty=True)).planner


def test_where_the_plan_of_the_library_goes_on_no_planner_is_asked(kitchen):
    reading = seen(kitchen, "pick_and_place(meal, hobs)")
    rest = remainder(reading, lunch_problem(), "no planner at all")
    assert (rest.actions, rest.waiting) == (reading.plan_for("tiago").actions, reading.plan_for("tiago").waiting)
    assert (rest.planner, rest.reason) == ("", "the plan of lunch goes on as it is")


def test_where_no_plan_explains_what_was_seen_a_planner_is_asked(kitchen, planner):
    reading = seen(kitchen, "pick_and_place(meal, hobs)", "pick_and_place(meal, hobs)")
    assert not reading.count
    rest = remainder(reading, lunch_problem(), planner)
    assert rest.reason == "no plan of the library explains what was observed"
    assert "wash(plate, sink)" in map(str, rest.actions)


def test_what_is_done_of_the_rest_is_left_out_of_it(kitchen):
    rest = remainder(seen(kitchen, "pick_and_place(meal, hobs)"), lunch_problem(dirty=True), "pyperplan")
    first = rest.leaves[0]
    later = type(rest.situation).of(rest.situation.plan, rest.situation.closed | 1 << first, ())
    assert rest.after(later).actions == rest.actions[1:]


@pytest.mark.parametrize(
    ("observed", "problem", "planner", "told"),
    [
        (["pick_and_place(meal, plate)"], {"dirty": True}, None, "step 1, pick_and_place.meal, plate.: nothing makes clean.plate. hold"),
        (["pick_and_place(meal, hobs)"], {"dirty": True}, "nobody", "there is no planner nobody; there are"),
        (["pick_and_place(meal, hobs)"], {"dirty": True, "can_wash": False}, "fast-downward", "Fast Downward proved that nothing leads"),
        (["pick_and_place"], {}, None, "no arguments were seen, so the state after it is not known"),
        (["pick_and_place(bottle, glass)"], {}, None, "the problem has no thing bottle: is it the problem of this domain?"),
    ],
)  # fmt: skip
def test_a_mistake_is_one_sentence(kitchen, observed, problem, planner, told):
    with pytest.raises(CasperError, match=told):
        remainder(seen(kitchen, *observed), lunch_problem(**problem), planner)


def test_a_problem_of_another_domain_is_refused(kitchen, examples):
    with pytest.raises(CasperError, match="the problem has no action pick_and_place; it has a: is it of this domain"):
        remainder(seen(kitchen, "pick_and_place(meal, hobs)"), examples["basic"].problem)


def test_a_problem_that_wants_tasks_only_is_refused(kitchen, examples):
    with pytest.raises(CasperError, match="the problem wants tasks and no state: add a goal"):
        remainder(seen(kitchen, "pick_and_place(meal, hobs)"), examples["htn-go"].problem)


def test_the_framework_is_left_as_it_was(kitchen):
    stream = get_environment().credits_stream
    remainder(seen(kitchen, "pick_and_place(meal, hobs)"), lunch_problem(dirty=True), "pyperplan")
    assert get_environment().credits_stream is stream


def test_an_imported_lunch_verifies_what_its_problem_allows():
    domain = from_problem(lunch_problem(agents=True), agent="agent")
    assert (domain.partner, domain.robot) == ("human", "tiago")
    assert domain.kb.verify("pick_and_place(tiago, meal, hobs)").valid
    refused = domain.kb.verify("cook(tiago, meal, hobs)")
    assert refused.valid is False
    assert "holds(on(meal, hobs), now) does not hold" in refused.reasons
