"""Several partners in one world: each has a mind of their own, and one robot helps them all."""

import json

import pytest

from casper import Domain, Mind
from casper.engine.live import Live, Partners, by_day
from casper.engine.perception.world import AgentState, ObjectState, WorldState, world_state_to_json
from casper.engine.verification.observation import Observation
from casper.kb.errors import DomainError
from casper.kb.terms.terms import Compound
from casper.streams.watching import watched

KITCHEN = Domain.load("kitchen")
PLACES = {
    "biscuits": (1.0, 0.0), "plate": (5.0, 0.0), "bottle": (1.0, 9.0), "glass": (5.0, 9.0),
    "sink": (5.0, 5.0), "hobs": (0.0, 5.0),
}  # fmt: skip


@pytest.fixture
def home(tmp_path):
    """The kitchen with a second human, ann."""
    for file in KITCHEN.folder.iterdir():
        (tmp_path / file.name).write_text(file.read_text())
    (tmp_path / "ontology.pl").open("a").write("human(ann).\n")
    return tmp_path


def moments(y, thing):
    """Where somebody is who stands, carries a thing from x=1 to x=5 and uses it there: x, what is held, where it is."""
    carrying = [0.5 + 0.3 * step for step in range(15)]
    found = [(0.5, None, (1.0, y))] * 8 + [(x, thing, (x, y)) for x in (0.5, 0.5, *carrying)]
    for _ in range(4):
        found += [(4.7, thing, (5.0, y))] * 6 + [(4.7, None, (5.0, y))] * 6
    return found


def states(names=("human", "ann")):
    """The human has breakfast at the south, ann a drink at the north, at the same time."""
    for step, pair in enumerate(zip(moments(0.0, "biscuits"), moments(9.0, "bottle")), 1):
        agents, places = {}, dict(PLACES)
        for name, (x, held, at), thing, y in zip(("human", "ann"), pair, ("biscuits", "bottle"), (0.0, 9.0)):
            if name in names:
                agents[name] = AgentState(x, y, 0.0, held)
                places[thing] = at
        objects = {name: ObjectState(*at, 0.8) for name, at in places.items()}
        yield WorldState(0.5 * step, agents, objects)


def told(minds, worlds):
    return [event for world in worlds for event in minds.update(world)]


def alone(events, name):
    return [e.to_json() for e in events if name in (e.data.get("agent"), e.data.get("partner"))]


def test_two_partners_with_goals_of_their_own_are_read_as_if_each_were_alone(home):
    domain = Domain.load(home)
    together = told(Partners(domain), states())
    for name, goal in (("human", "breakfast"), ("ann", "drink")):
        by_themselves = told(Mind(domain, partner=name), states())
        assert alone(together, name) == [e.to_json() for e in by_themselves]
        assert {e.data["goal"] for e in by_themselves if e.type == "prediction"} == {goal}


def test_every_event_names_the_agent_and_the_robots_the_partner_too(home):
    events = told(Partners(Domain.load(home)), states())
    assert {event.data["agent"] for event in events} == {"human", "ann", "tiago"}
    assert {e.type for e in events if e.data["agent"] == "tiago"} == {"plan", "says"}
    assert {e.data["partner"] for e in events if e.type == "plan"} == {"human", "ann"}


def test_a_single_partner_is_told_of_as_a_mind_tells_it():
    assert [e.to_json() for e in told(Partners(KITCHEN), states(("human",)))] == [
        e.to_json() for e in told(Mind(KITCHEN), states(("human",)))
    ]


def test_only_those_whom_a_setting_names_are_watched(home):
    (home / "ontology.pl").open("a").write("setting(agents, partner, ann).\n")
    assert {e.data["agent"] for e in told(Partners(Domain.load(home)), states())} == {"ann", "tiago"}


def test_somebody_the_domain_does_not_know_is_told_once_with_what_to_do():
    events = told(Partners(KITCHEN), states())
    (warning,) = [e for e in events if e.type == "warning"]
    assert warning.data == {
        "agent": "ann",
        "message": "ann is in view and nobody the domain knows, so nothing ann does is read; "
        "state human(ann) in ontology.pl to have it read",
    }


@pytest.mark.parametrize(("role", "kind"), [("partner", "human"), ("robot", "robot")])
def test_a_partner_who_is_not_in_the_world_is_refused_with_the_line_and_what_to_do(home, role, kind):
    (home / "ontology.pl").open("a").write(f"setting(agents, {role}, eve).\n")
    line = len((home / "ontology.pl").read_text().splitlines())
    with pytest.raises(DomainError) as mistake:
        Partners(Domain.load(home))
    there = "human, ann" if kind == "human" else "tiago"
    said = f"the {role} eve is not in the world; state {kind}(eve) in ontology.pl, or name one there is: {there}"
    assert mistake.value.sentence == said
    assert str(mistake.value.place).startswith(f"{home / 'ontology.pl'}:{line}")


def test_check_finds_a_partner_who_is_not_in_the_world(home):
    from casper.engine.domain.check import check_domain

    (home / "ontology.pl").open("a").write("setting(agents, partner, eve).\n")
    assert any("the partner eve is not in the world" in str(finding) for finding in check_domain(home))


def read(minds, name, *actions):
    """Actions of a partner, with their arguments as text; the events."""
    mind, events = minds.minds[name], []
    for text in actions:
        action, _, args = text.rstrip(")").partition("(")
        events += mind._read(Observation(action, tuple(args.split(", "))), 1.0)
    return events


@pytest.fixture
def both(home):
    minds = Partners(Domain.load(home))
    minds.update(next(states()))
    return minds


def test_what_fits_the_goal_of_the_other_partner_only_is_a_step_of_that(both):
    read(both, "human", "pick_and_place(meal, hobs)")
    events = read(both, "ann", "cook(meal, hobs)")
    assert {(e.data.get("partner", e.data["agent"]), e.data["by"]) for e in events} == {("human", "ann")}
    assert len(both.minds["human"].reading.observations) == 2
    assert both.minds["ann"].course.current.begun is None


def test_what_begins_a_goal_of_their_own_is_not_ascribed_to_the_other(both):
    read(both, "human", "pick_and_place(meal, hobs)")
    read(both, "ann", "pick_and_place(bottle, glass)")
    assert both.minds["ann"].reading.outcome == "drink"
    assert len(both.minds["human"].reading.observations) == 1


def test_what_the_robot_did_closes_the_episode_whose_part_it_was(both):
    read(both, "human", "pick_and_place(biscuits, plate)", "eat(biscuits, plate)")
    read(both, "ann", "pick_and_place(bottle, glass)", "sip(bottle, glass)")
    events = [e for a in ("pick_and_place", "wash") for e in both.did(Compound((a, "glass", "sink")), 9.0)]
    assert [(e.type, e.data["agent"], e.data["goal"]) for e in events] == [("episode", "ann", "drink")]
    assert [row["agent"] for row in both.summary()["episodes"]] == ["ann"]


def test_what_one_partner_and_the_robot_did_has_happened_for_the_other(home):
    (home / "ontology.pl").open("a").write(
        'never("nobody drinks after the meal was put away") :- claim(pick_and_place(_, bottle, _)), '
        "did(pick_and_place(_, plate, sink), _).\n"
    )
    minds = Partners(Domain.load(home))
    minds.update(next(states()))
    minds.did(Compound(("pick_and_place", "plate", "sink")), 0.6)
    told_ = told(minds, list(states())[1:])
    refused = [e.data for e in told_ if e.type == "verdict" and not e.data["valid"]]
    assert refused[0]["agent"] == "ann"
    assert refused[0]["reasons"] == ["nobody drinks after the meal was put away"]


# --- from a stream -------------------------------------------------------------------------------------------------------


def lines(worlds):
    return [json.dumps(world_state_to_json(world)) for world in worlds]


def report(t, action, status="done"):
    return json.dumps({"type": "robot", "t": t, "action": action, "status": status})


def test_a_recording_of_two_partners_is_watched(home):
    events = list(watched(Partners(Domain.load(home)), lines(states())))
    assert {(e.data["agent"], e.data["goal"]) for e in events if e.type == "prediction"} == {("human", "breakfast"), ("ann", "drink")}
    assert [(e.data["agent"], e.data["outcome"]) for e in events if e.type == "episode"] == [("human", "unclear"), ("ann", "unclear")]
    assert len(events[-1].data["episodes"]) == 2


def test_what_a_robot_reports_in_between_closes_the_episode():
    seen = lines(states(("human",)))
    done = [report(40.0, "pick_and_place(plate, sink)"), report(41.0, "wash(plate, sink)")]
    events = list(watched(Partners(KITCHEN), [*seen, *done]))
    (episode,) = [e for e in events if e.type == "episode"]
    assert (episode.t, episode.data["outcome"]) == (41.0, "finished")


@pytest.mark.parametrize(
    ("line", "said"),
    [
        (report(-1.0, "wash(plate, sink)"), "time must not run backwards: what the robot did at t=-1 came after t=0"),
        (report("soon", "wash(plate, sink)"), 'what the robot did has no finite number under "t"'),
        (report(1.0, None), 'needs an "action" and a "status", one of asked, done, failed, stopped'),
        (report(1.0, "wash(plate, sink)", "liked"), 'needs an "action" and a "status", one of asked, done, failed, stopped'),
        (report(1.0, "wash(plate"), "line 1 is left out"),
    ],
)
def test_a_report_that_cannot_be_used_is_left_out_with_a_sentence(line, said):
    warning, summary = watched(Partners(KITCHEN), [line])
    assert said in warning.data["message"]
    assert summary.type == "summary"


def test_partners_follow_the_files_of_their_domain(home):
    live, undisturbed = Live(Partners(Domain.load(home))), Partners(Domain.load(home))
    events = []
    for number, world in enumerate(states()):
        if number % 20 == 10:
            (home / "ontology.pl").open("a").write(f"% remark {number}\n")
            assert live.refresh() == ("the domain was read anew",)
        events += live.mind.update(world)
    kinds = ("verdict", "reading", "prediction", "plan")
    expected = [e.to_json() for e in told(undisturbed, states()) if e.type in kinds]
    assert [e.to_json() for e in events if e.type in kinds] == expected
    assert live.mind.summary() == undisturbed.summary()


def test_a_day_s_hypotheses_may_place_the_actions_of_all_partners(home):
    domain = Domain.load(home)
    by_sight = told(Partners(domain), states())
    by_day_ = told(Partners(domain, segments=by_day(domain)), states())
    goals = [[(e.data["agent"], e.data["goal"]) for e in events if e.type == "prediction"] for events in (by_sight, by_day_)]
    assert goals[0] == goals[1] and len(goals[0]) == 2
