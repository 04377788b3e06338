"""A domain's own rules ask a running mind what it saw: contexts, constraints, partners; others pay nothing."""

from __future__ import annotations

import shutil

import pytest
from test_mind import breakfast_states

from casper import Domain, Mind
from casper.engine.domain.check import check_domain
from casper.engine.domain.domain import SHIPPED
from casper.engine.live.partners import Partners
from casper.engine.live.renewal import renewed
from casper.engine.perception.world import AgentState

CARRIED = "carried(A, T) :- during(hold(A, T), From, To), To - From >= 2."
LOOKED_FOR = 'never("nobody eats what nobody brought") :- claim(eat(A, T, _)), \\+ carried(A, T).'
NEVER_SEEN = 'never("nobody eats after dark") :- claim(eat(A, _, _)), qdc(_, A, lamp, far).'
EATS = "context(use, plate, eat) :- during(hold(human, biscuits), From, To), To - From >= {}.\n"


def kitchen(folder, ontology="", context=None):
    """The shipped kitchen with a few rules more, or another meaning of a use at the plate."""
    shutil.copytree(SHIPPED / "kitchen", folder)
    with (folder / "ontology.pl").open("a") as text:
        text.write(f"{CARRIED}\n{ontology}\n")
    if context is not None:
        actions = (folder / "actions.pl").read_text().replace("context(use, plate, eat).\n", context)
        (folder / "actions.pl").write_text(actions)
    return Domain.load(folder)


def told(mind, states=None):
    return [event for state in states or breakfast_states() for event in mind.update(state)]


def statements(events):
    return {event.data["statement"]: event.data["valid"] for event in events if event.type == "verdict"}


def test_a_constraint_asks_what_was_seen(tmp_path):
    mind = Mind(kitchen(tmp_path / "home", LOOKED_FOR))
    assert statements(told(mind))["eat(human, biscuits, plate)"] is True
    assert mind.known.ask("carried(human, biscuits)")


def test_what_could_not_be_seen_is_an_unknown_verdict_with_its_reason(tmp_path):
    events = told(Mind(kitchen(tmp_path / "home", NEVER_SEEN)))
    assert statements(events)["eat(human, biscuits, plate)"] is None
    reasons = next(e.data["reasons"] for e in events if e.type == "verdict" and e.data["valid"] is None)
    assert "lamp" in reasons[0] and "undefined" in reasons[0]


@pytest.mark.parametrize(("seconds", "eaten"), [(3, True), (60, False)])
def test_a_context_decides_by_what_was_seen(tmp_path, seconds, eaten):
    events = told(Mind(kitchen(tmp_path / "home", context=EATS.format(seconds))))
    assert ("eat(human, biscuits, plate)" in statements(events)) is eaten


def test_a_context_that_cannot_be_told_is_said_and_not_taken_for_a_no(tmp_path):
    events = told(Mind(kitchen(tmp_path / "home", context=EATS.format(60))))
    warnings = [event.data["message"] for event in events if event.type == "warning"]
    assert any(w.startswith("what use means at plate is not known: ") for w in warnings)
    assert len(warnings) == len(set(warnings))


def test_partners_share_what_was_seen_of_each(tmp_path):
    domain = kitchen(tmp_path / "home", "human(bob). " + LOOKED_FOR)
    partners = Partners(domain)
    for state in breakfast_states():
        agents = {**state.agents, "bob": AgentState(-1.0, -1.0, 0.0)}
        partners.update(type(state)(state.t, agents, state.objects))
    for mind in partners.minds.values():
        assert mind.known.ask("carried(human, biscuits)")
        assert next(mind.known.query("during(mos(bob, stationary), From, To), From >= 0"))["From"] > 0


def test_a_mind_that_is_renewed_remembers_what_it_saw(tmp_path):
    domain = kitchen(tmp_path / "home", LOOKED_FOR)
    mind = Mind(domain)
    told(mind)
    again, _ = renewed(mind, Domain.load(tmp_path / "home"))
    assert again.known.ask("carried(human, biscuits)")


def test_a_domain_that_does_not_ask_remembers_nothing():
    mind = Mind(Domain.load("kitchen"))
    told(mind, breakfast_states()[:10])
    assert mind.memories.of == {} and mind.known is mind.domain.kb


@pytest.mark.parametrize(
    ("rule", "sentence"),
    [
        ("a(T) :- qdc(T, human, plate, neer).", "qdc has touch, near, medium, far, ignore; did you mean near?"),
        ("a(T) :- qtc(T, human, plate, towards).", "did you mean toward?"),
        ("a(S) :- \\+ during(holds(human, S), _, _), b(S). b(plate).", "what lasts is one of qdc/3, qtc/3, mos/2, hold/2"),
    ],
)
def test_a_check_finds_what_can_never_be_seen(tmp_path, rule, sentence):
    kitchen(tmp_path / "home", rule)
    assert any(sentence in finding.message for finding in check_domain(tmp_path / "home"))


def test_a_check_knows_the_names(tmp_path):
    kitchen(tmp_path / "home", LOOKED_FOR)
    (tmp_path / "home" / "tests.pl").unlink()  # which has somebody eat whom nobody has seen
    found = [finding.message for finding in check_domain(tmp_path / "home")]
    assert not any("during" in message or "carried" in message for message in found)
