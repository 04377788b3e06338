"""Bases, domains and readings in other processes, and in copies: they arrive, and go their own way."""

from __future__ import annotations

import copy
import operator
import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import BASE, DERIVED, programs

from casper.engine.domain.domain import Domain
from casper.engine.reading.reading import Reading
from casper.engine.verification.matching import NameMatcher
from casper.kb.base import KnowledgeBase
from casper.kb.terms.terms import Compound, make_list
from casper.plans.library import PlanLibrary

INDICATORS = [*BASE.items(), *DERIVED.items()]
SEEN = ("pick_and_place(biscuits, plate)", "eat(biscuits, plate)", "pick_and_place(plate, sink)")


def sent(thing):
    return pickle.loads(pickle.dumps(thing))


WAYS_TO_COPY = pytest.mark.parametrize("copied", [sent, copy.deepcopy, copy.copy], ids=["pickled", "deep", "shallow"])


def rows_of(base):
    stored = {i: base.stored(i) for i in INDICATORS}
    return {i: (set(rows), set(rows.undefined or ())) for i, rows in stored.items()}


@WAYS_TO_COPY
@given(text=programs())
def test_a_base_arrives_with_all_it_says(copied, text):
    base = KnowledgeBase.from_text(text)
    arrived = copied(base)
    assert rows_of(arrived) == rows_of(base)
    assert arrived.to_text() == base.to_text()


@WAYS_TO_COPY
def test_a_copy_goes_its_own_way(copied):
    base = KnowledgeBase.from_text("agent(X) :- human(X). human(ann).")
    base.facts("human", [("bob",), ("eve",)])
    base.declare_statements([("agent", 1)])
    arrived = copied(base)
    arrived.assert_("human(joe)")
    arrived.retract("human(bob)")
    assert not base.ask("agent(joe)") and base.ask("agent(bob)")
    assert arrived.ask("agent(joe)") and not arrived.ask("agent(bob)")
    assert {answer["S"] for answer in arrived.query("valid(S)")} == {Compound(("agent", x)) for x in ("ann", "eve", "joe")}


def test_a_clause_arrives_with_its_place():
    base = sent(KnowledgeBase.from_text("human(ann).\nagent(X) :- human(X).", "home.pl"))
    assert "home.pl:2" in str(base.why("agent(ann)"))


def test_an_assumption_arrives_as_the_base_it_supposes():
    base = KnowledgeBase.from_text("agent(X) :- human(X). human(ann).").assume("human(bob)", without=["human(ann)"])
    assert list(sent(base).query("agent(X)")) == [{"X": "bob"}]


def test_a_predicate_is_reached_by_name_in_what_arrived():
    from kanren import run, var

    base = KnowledgeBase.from_text("human(ann).")
    x = var()
    assert run(0, x, base.human(x)) == ("ann",)
    arrived = sent(base)
    arrived.assert_("human(bob)")
    assert set(run(0, x, arrived.human(x))) == {"ann", "bob"}


@pytest.mark.parametrize("length", [0, 1, 5_000])
def test_a_long_list_arrives(length):
    fact = Compound(("holds", make_list([str(at) for at in range(length)])))
    assert sent(fact).indicator == ("holds", 1)
    walked, item = 0, sent(fact)[1]
    while item != "[]":
        assert item[1] == str(walked)
        walked, item = walked + 1, item[2]
    assert walked == length


@given(st.recursive(st.sampled_from(["a", 1, 0.5, Compound(("f",))]), lambda x: st.builds(lambda p: Compound(("f", *p)), st.lists(x, max_size=3))))
def test_a_term_arrives_as_itself(term):
    assert sent(term) == term and type(sent(term)) is type(term)


@WAYS_TO_COPY
def test_a_domain_arrives_and_reads(copied):
    domain = Domain.load("kitchen")
    domain.reading()  # what is worked out for readings stays behind
    arrived = copied(domain)
    assert (arrived.name, arrived.folder, arrived.fingerprint) == (domain.name, domain.folder, domain.fingerprint)
    assert arrived.library.to_text() == domain.library.to_text()
    here, there = domain.reading(), arrived.reading()
    for action in SEEN:
        here.observe(action)
        there.observe(action)
    assert there.to_json() == here.to_json()


@WAYS_TO_COPY
@pytest.mark.parametrize(
    "options",
    [{}, {"verification": False}, {"noise": 0.1}, {"goals": 2}, {"policy": "best", "score": "coverage"}],
    ids=["paper", "names", "noise", "two goals", "coverage"],
)
def test_a_reading_arrives_where_it_was_and_goes_on_on_its_own(copied, options):
    reading = Domain.load("kitchen").reading(**options)
    reading.observe("sip(bottle, glass)" if options.get("goals") else SEEN[0])
    reading.observe({SEEN[1]: 0.5, "sip": 0.2})
    arrived = copied(reading)
    assert arrived.to_json() == reading.to_json()
    assert arrived.plan_for("tiago") == reading.plan_for("tiago")
    before = reading.to_json()
    arrived.observe(SEEN[2])
    assert reading.to_json() == before
    reading.observe(SEEN[2])
    assert arrived.to_json() == reading.to_json()
    arrived.undo()
    assert arrived.to_json() == before


def test_a_reading_without_a_domain_arrives_too():
    library = PlanLibrary.from_text("tea --> boil, pour. soup --> boil, stir.")
    reading = Reading(library, NameMatcher(library.ways))
    reading.observe("boil")
    arrived = sent(reading)
    arrived.observe("pour")
    assert (arrived.outcome, reading.outcome) == ("tea", None)


def test_what_a_reading_asks_in_its_new_place_is_its_own_base():
    reading = sent(Domain.load("kitchen").reading())
    domain = reading._capability.__self__
    assert reading._unused.kb is domain.kb and reading.library is domain.library


def test_workers_of_joblib_ask_and_prove():
    joblib = pytest.importorskip("joblib", reason="joblib is not installed: pip install casper-hri[batch]")
    base = KnowledgeBase.from_text("agent(X) :- human(X). human(ann). human(bob).")
    asked = [f"agent({name})" for name in ("ann", "bob", "eve")]
    parallel = joblib.Parallel(n_jobs=2, backend="loky")
    assert parallel(joblib.delayed(base.ask)(statement) for statement in asked) == [True, True, False]
    proofs = parallel(joblib.delayed(base.why)(statement) for statement in asked[:2])
    assert proofs == [base.why(statement) for statement in asked[:2]]


def test_workers_of_joblib_go_on_with_a_reading():
    joblib = pytest.importorskip("joblib", reason="joblib is not installed: pip install casper-hri[batch]")
    reading = Domain.load("kitchen").reading()
    reading.observe(SEEN[0])
    ask = operator.methodcaller("to_json")
    shown = joblib.Parallel(n_jobs=2, backend="loky")(joblib.delayed(ask)(each) for each in (reading, reading.fork()))
    assert shown == [reading.to_json()] * 2


def test_workers_of_dask_ask():
    distributed = pytest.importorskip("distributed", reason="dask is not installed: pip install casper-hri[batch]")
    base = KnowledgeBase.from_text("agent(X) :- human(X). human(ann).")
    cluster = distributed.LocalCluster(n_workers=1, threads_per_worker=2, dashboard_address=None)
    with cluster, distributed.Client(cluster) as client:
        remote = client.scatter(base)
        asked = [client.submit(KnowledgeBase.ask, remote, f"agent({name})", pure=False) for name in ("ann", "eve")]
        assert client.gather(asked) == [True, False]
        reading = client.submit(Domain.reading, Domain.load("kitchen"), pure=False).result()
    reading.observe(SEEN[0])
    assert reading.count
