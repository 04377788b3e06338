"""Hot reload: changed files are taken in while a reading or a mind goes on, and a mistake in them changes nothing."""

import shutil

import pytest

from casper.engine.domain.domain import SHIPPED, Domain
from casper.engine.domain.reload import carried_over, reloaded
from casper.engine.live import Live, renewed
from casper.engine.mind import Mind
from casper.engine.perception.world import AgentState, ObjectState, WorldState
from casper.kb.errors import CasperError, ReadError


@pytest.fixture
def folder(tmp_path):
    shutil.copytree(SHIPPED / "kitchen", tmp_path / "kitchen")
    return tmp_path / "kitchen"


def change(folder, file, old, new):
    text = (folder / file).read_text()
    assert old in text
    (folder / file).write_text(text.replace(old, new))


def observing(domain, *actions):
    reading = domain.reading()
    for action in actions:
        reading.observe(action)
    return reading


# --- the domain -----------------------------------------------------------------------------------------------------


def test_what_has_not_changed_is_the_same_object(folder):
    domain = Domain.load(folder)
    (folder / "plans.pl").touch()
    assert reloaded(domain) is domain


def test_a_changed_file_is_read_anew_and_the_old_domain_stays_as_it_was(folder):
    domain = Domain.load(folder)
    change(folder, "ontology.pl", "sink(sink).", "sink(sink). sink(basin).")
    fresh = reloaded(domain)
    assert fresh.kb.ask("sink(basin)")
    assert not domain.kb.ask("sink(basin)")
    assert reloaded(fresh) is fresh


def test_a_change_in_an_included_file_counts(folder):
    (folder / "more.pl").write_text("sink(basin).\n")
    change(folder, "ontology.pl", "sink(sink).", 'sink(sink).\n:- include("more.pl").')
    domain = Domain.load(folder)
    (folder / "more.pl").write_text("sink(tub).\n")
    assert reloaded(domain).kb.ask("sink(tub)")


def test_a_file_that_comes_or_goes_counts(folder):
    domain = Domain.load(folder)
    (folder / "ontology.pl").unlink()
    bare = reloaded(domain)
    assert not bare.verifies
    shutil.copy(SHIPPED / "kitchen" / "ontology.pl", folder)
    assert reloaded(bare).verifies


def test_a_mistake_is_told_with_its_place(folder):
    domain = Domain.load(folder)
    change(folder, "plans.pl", "goal(lunch(Food))     :- meal(Food).", "goal(lunch(Food) :- meal(Food).")
    with pytest.raises(ReadError, match=r"plans\.pl:5:"):
        reloaded(domain)


# --- a reading ------------------------------------------------------------------------------------------------------


def test_a_reading_keeps_its_observations(folder):
    domain = Domain.load(folder)
    reading = observing(domain, "pick_and_place(meal, hobs)", "cook", "eat(meal, plate)")
    change(folder, "plans.pl", "eat(Food, plate), clean(plate).\ndrink", "eat(Food, plate), clean(plate).\n% a remark\ndrink")
    fresh, dropped = carried_over(reading, reloaded(domain))
    assert dropped == ()
    assert fresh.to_json() == reading.to_json()


def test_observations_that_fit_no_more_are_told_and_the_others_stay(folder):
    domain = Domain.load(folder)
    reading = observing(domain, "pick_and_place(biscuits, plate)", "eat(biscuits, plate)", "wash")
    change(folder, "ontology.pl", "eatable(biscuits).", "")
    fresh, dropped = carried_over(reading, reloaded(domain))
    assert [str(o) for o in fresh.observations] == ["pick_and_place(biscuits, plate)", "wash"]
    assert [d.observed for d in dropped] == ["eat(biscuits, plate)"]
    assert "biscuits is not eatable" in str(dropped[0])


def test_an_action_that_no_plan_has_any_more_is_told(folder):
    domain = Domain.load(folder)
    reading = observing(domain, "pick_and_place(meal, hobs)", "cook")
    change(folder, "plans.pl", ", cook(Food, hobs)", "")
    fresh, dropped = carried_over(reading, reloaded(domain))
    assert [str(o) for o in fresh.observations] == ["pick_and_place(meal, hobs)"]
    assert "no plan has the action cook" in str(dropped[0])


def test_policy_and_verification_are_those_asked_for(folder):
    domain = Domain.load(folder)
    reading = observing(domain, "eat")
    assert carried_over(reading, domain)[0].outcome is None
    assert carried_over(reading, domain, "best")[0].outcome == "breakfast"
    assert carried_over(reading, domain, verification=False)[0].count == reading.count


# --- a mind ---------------------------------------------------------------------------------------------------------

PLACES = {"biscuits": (1.0, 0.0), "plate": (5.0, 0.0), "sink": (5.0, 5.0), "hobs": (0.0, 5.0)}


def states():
    """A partner takes the biscuits to the plate and eats: eight steps standing, then carrying, then picks and places."""
    t = 0.0
    carrying = [0.5 + 0.3 * step for step in range(15)]
    moments = [(0.5, None, (1.0, 0.0))] * 8 + [(x, "biscuits", (x, 0.0)) for x in (0.5, 0.5, *carrying)]
    for _ in range(4):
        moments += [(4.7, "biscuits", (5.0, 0.0))] * 6 + [(4.7, None, (5.0, 0.0))] * 6
    for x, holding, biscuits in moments:
        t += 0.5
        objects = {name: ObjectState(*{**PLACES, "biscuits": biscuits}[name], 0.8) for name in PLACES}
        yield WorldState(t, {"human": AgentState(x, 0.0, 0.0, holding)}, objects)


def watching(live, worlds):
    events = []
    for world in worlds:
        live.refresh()
        events += live.mind.update(world)
    return events


def concluded(events):
    return [(e.type, e.t) for e in events if e.type in ("verdict", "reading", "prediction", "plan")]


def test_a_mind_goes_on_as_if_nothing_had_happened_when_nothing_that_matters_changes(folder):
    undisturbed = watching(Live(Mind(Domain.load(folder))), states())
    assert {"prediction", "plan"} <= {e.type for e in undisturbed}
    live, events = Live(Mind(Domain.load(folder))), []
    for number, world in enumerate(states()):
        if number % 9 == 8:
            (folder / "ontology.pl").open("a").write(f"% remark {number}\n")
            assert live.refresh() == ("the domain was read anew",)
        events += live.mind.update(world)
    assert concluded(events) == concluded(undisturbed)
    assert live.mind.summary() == watched_summary(folder)


def watched_summary(folder):
    mind = Mind(Domain.load(folder))
    for world in states():
        mind.update(world)
    return mind.summary()


def test_a_mind_uses_the_new_rules_from_the_next_step_on(folder):
    live = Live(Mind(Domain.load(folder)))
    change(folder, "ontology.pl", 'never("the biscuits go on the plate only")', 'never("no") :- claim(pick_and_place(_, _, _)).\nnever("x")')
    verdicts = [e.data for e in watching(live, states()) if e.type == "verdict"]
    assert verdicts[0]["reasons"] == ["no"]


def test_what_is_not_valid_any_more_is_told_and_did_not_happen(folder):
    live = Live(Mind(Domain.load(folder)))
    watching(live, states())
    assert [str(o) for o in live.mind.reading.observations] == ["pick_and_place(biscuits, plate)", "eat(biscuits, plate)"]
    change(folder, "ontology.pl", "eatable(biscuits).", "")
    told = live.refresh()
    assert told[0] == "the domain was read anew"
    assert [message.split(" fits")[0] for message in told[1:]] == ["eat(biscuits, plate)"]
    assert [str(o) for o in live.mind.reading.observations] == ["pick_and_place(biscuits, plate)"]
    assert [repr(statement) for statement, _ in live.mind.verifier.history] == ["pick_and_place(human, biscuits, plate)"]


def test_a_commitment_that_stands_keeps_its_time(folder):
    domain = Domain.load(folder)
    mind = Mind(domain)
    for world in states():
        mind.update(world)
    fresh, _ = renewed(mind, domain)
    assert fresh.supervisor.commitment.t == mind.supervisor.commitment.t
    assert (fresh.supervisor.waiting, fresh.supervisor.actions) == (mind.supervisor.waiting, mind.supervisor.actions)


def test_where_things_were_seen_is_remembered_through_a_change_of_settings(folder):
    live = Live(Mind(Domain.load(folder)))
    first = next(iter(states()))
    live.mind.update(first)
    change(folder, "actions.pl", "setting(focus, threshold, 0.45).", "setting(focus, threshold, 0.4).")
    assert live.refresh() == ("the domain was read anew",)
    (focus, _) = live.mind.update(WorldState(1.0, dict(first.agents), {}))
    assert set(focus.data["scores"]) == set(PLACES)
    assert live.mind.focus.settings.threshold == 0.4


def test_a_mistake_leaves_the_old_domain_in_force_and_is_told_once(folder):
    live = Live(Mind(Domain.load(folder)))
    before = live.mind
    change(folder, "ontology.pl", "sink(sink).", "sink(sink.")
    (message,) = live.refresh()
    assert "the changed domain is not taken" in message and "ontology.pl:13:10" in message
    assert live.refresh() == ()
    assert live.mind is before
    change(folder, "ontology.pl", "sink(sink.", "sink(sink).")
    assert live.refresh() == ()
    change(folder, "ontology.pl", "sink(sink).", "sink(sink). ")
    assert live.refresh() == ("the domain was read anew",)


def test_a_setting_that_no_stage_understands_leaves_the_old_mind_as_it_was(folder):
    mind = Mind(Domain.load(folder))
    change(folder, "actions.pl", "setting(focus, threshold, 0.45).", "setting(focus, threshold, high).")
    domain = reloaded(mind.domain)
    tracker = mind.tracker.settings
    with pytest.raises(CasperError, match="should be a number"):
        renewed(mind, domain)
    assert mind.tracker.settings is tracker


# --- side by side ---------------------------------------------------------------------------------------------------


def test_two_domains_in_one_process_never_mix(folder):
    change(folder, "ontology.pl", "eatable(biscuits).", "")
    change(folder, "plans.pl", "goal(lunch(Food))     :- meal(Food).", "")
    shipped, other = Domain.load("kitchen"), Domain.load(folder)
    first, second = shipped.reading(), other.reading()
    for reading in (first, second):
        reading.observe("pick_and_place(plate, sink)")
    first.observe("wash(plate, sink)")
    assert shipped.kb.ask("eat(human, biscuits, plate)") and not other.kb.ask("eat(human, biscuits, plate)")
    assert set(shipped.library.goals) - set(other.library.goals) == {"lunch"}
    assert (len(first.observations), len(second.observations)) == (2, 1)
    other.kb.fact("eatable(biscuits)")
    other.kb.fact("sink(tub)")
    assert other.kb.ask("eat(human, biscuits, plate)") and not shipped.kb.ask("sink(tub)")


def test_a_domain_can_ask_about_another_one_beside_it(folder):
    home = folder.parent / "home"
    home.mkdir()
    (home / "ontology.pl").write_text(
        ':- use("../kitchen", as(kitchen)).\nhuman(ann).\nbring(A, T) :- human(A), kitchen:moveable(T), kitchen:eatable(T).\n'
    )
    (home / "plans.pl").write_text("goal(picnic).\npicnic --> bring(T), bring(T).\n")
    domain = Domain.load(home)
    assert {row["T"] for row in domain.kb.query("bring(ann, T)")} == {"biscuits", "meal"}
    assert domain.partner == "ann"
    assert not domain.kb.defines("moveable", 1)
    assert domain.kb.verify("kitchen:pick_and_place(human, biscuits, hobs)").reasons == ("the biscuits go on the plate only",)
    assert domain.kb.verify("kitchen:pick_and_place(human, biscuits, plate)").valid
    change(folder, "ontology.pl", "eatable(biscuits).", "")
    assert {row["T"] for row in reloaded(domain).kb.query("bring(ann, T)")} == {"meal"}


def test_a_shipped_domain_can_be_used_by_its_name(tmp_path):
    (tmp_path / "ontology.pl").write_text(':- use("kitchen", as(k)).\nhuman(ann).\nsee(A, T) :- human(A), k:item(T).\n')
    assert Domain.load(tmp_path).kb.ask("see(ann, plate)")
