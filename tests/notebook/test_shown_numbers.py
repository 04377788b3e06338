"""HTML and pictures show the same numbers as the JSON."""

import re

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from markup import numbers, parsed, words
from readings import KITCHEN, reading

from casper.engine.events.curves import focus_curve
from casper.engine.events.event import Event
from casper.engine.events.shares import MOST_GOALS
from casper.notebook.curves import HIGH, TOP, WIDE
from casper.notebook.trees import STYLES
from casper.plans.trees.tree import MARKS

ACTIONS = ["pick_and_place(meal, hobs)", "pick_and_place", "eat", "sip", "cook", "wash", "eat(biscuits, plate)"]
SHARES = st.dictionaries(st.sampled_from(["meal", "plate", "<sink>", "é"]), st.floats(0, 1))


def bars(root):
    return [float(re.fullmatch(r"width:([\d.]+)%", i.get("style"))[1]) / 100 for i in root.iter("i")]


@settings(max_examples=25)
@given(st.lists(st.sampled_from(ACTIONS), max_size=4), st.sampled_from([None, 0.1]), st.sampled_from([1, 2]))
def test_a_reading_shows_the_numbers_of_its_json(observed, noise, goals):
    read = reading(*observed, noise=noise, goals=goals)
    told, root = read.to_json(), parsed(read._repr_html_())
    first, *rest = numbers(root)
    scores = [number for entry in told["best"] for number in (entry["score"], entry["share"])]
    assert [first, *rest] == [told["explanations"], told["confidence"], *told["posterior"].values(), *scores]
    assert bars(root) == pytest.approx([min(share, 1) for share in told["posterior"].values()], abs=1e-6)


def test_of_many_goals_the_likeliest_are_shown_and_the_others_counted():
    from casper import Domain

    plans = "".join(f"g{n} --> a{n % 7}, b{n}.\n" for n in range(MOST_GOALS + 5))
    read = Domain.from_text(plans=plans).reading()
    read.observe("a3")
    root = parsed(read._repr_html_())
    assert len(bars(root)) == MOST_GOALS
    assert "… and 5 goals that are no likelier" in words(root)


@settings(max_examples=15)
@given(st.lists(st.sampled_from(ACTIONS), min_size=1, max_size=3))
def test_a_tree_shows_each_leaf_with_the_mark_of_its_status(observed):
    for explanation in reading(*observed, noise=0.1).best(3):
        groups = [g.get("class").split() for g in parsed(explanation._repr_svg_()).iter("g")]
        assert [status for kind, status in groups if kind == "action"] == list(explanation.status)
        texts = [g.find("text").text for g in parsed(explanation._repr_svg_()).iter("g")]
        leaves = explanation.to_json()["leaves"]
        assert [t for t in texts if t[0] in MARKS.values()] == [f"{MARKS[x['status']]} {x['action']}" for x in leaves]


def test_every_status_has_a_look_of_its_own():
    assert set(STYLES) == set(MARKS)
    assert len({str(style) for style in STYLES.values()}) == len(MARKS)


@settings(max_examples=25)
@given(st.lists(SHARES, min_size=1, max_size=12))
def test_a_focus_curve_is_drawn_where_its_shares_are(rows):
    events = [
        Event("focus", 0.5 * at, {"target": None, "destination": None, "scores": row}) for at, row in enumerate(rows)
    ]
    curve = focus_curve(events)
    drawn = {}
    for line in parsed(curve._repr_svg_()).iter("polyline"):
        points = [tuple(map(float, point.split(","))) for point in line.get("points").split()]
        drawn.setdefault(line.find("title").text, []).extend(1 - (y - TOP) / HIGH for _, y in points)
    told = curve.to_json()["shares"]
    assert set(drawn) == set(told)
    for name, shares in told.items():
        assert drawn[name] == pytest.approx([share for share in shares if share is not None], abs=1e-5)


def test_the_target_of_a_focus_curve_is_a_band_from_when_it_was_chosen():
    targets = [None, "meal", "meal", "plate", "plate"]
    events = [
        Event("focus", float(t), {"target": n, "destination": None, "scores": {"meal": 0.5}})
        for t, n in enumerate(targets)
    ]
    bands = {r.find("title").text: float(r.get("width")) for r in parsed(focus_curve(events)._repr_svg_()).iter("rect")}
    assert bands == {"the target is meal from 1 s": WIDE / 2, "the target is plate from 3 s": WIDE / 4}


def test_a_proof_shows_the_steps_of_its_json():
    proof = KITCHEN.kb.why("wash(tiago, plate, sink)")

    def facts(told):
        return [told["fact"], *(fact for premise in told["because"] for fact in facts(premise))]

    assert [code.text for code in parsed(proof._repr_html_()).iter("code")] == facts(proof.to_json())


def test_a_collaborative_plan_shows_what_is_waited_for_and_what_is_done():
    plan = reading("pick_and_place(meal, hobs)").plan_for("tiago")
    told = plan.to_json()
    assert [code.text for code in parsed(plan._repr_html_()).iter("code")] == [*told["waiting"], *told["actions"]]


def test_a_domain_shows_its_constraints_and_a_tree_for_each_plan():
    root = parsed(KITCHEN._repr_html_())
    assert "the biscuits go on the plate only" in words(root)
    assert len(list(root.iter("svg"))) == len(KITCHEN.library.ways)


def test_a_proof_is_told_in_the_authors_words_beside_its_terms():
    from casper.kb.base import KnowledgeBase

    kb = KnowledgeBase.from_text('human(ann). agent(X) :- human(X). say(agent(A), "{A} can act"). say(ann, "Ann").')
    root = parsed(kb.why("agent(ann)")._repr_html_())
    assert "Ann can act" in words(root)
    assert [code.text for code in root.iter("code")] == ["agent(ann)", "human(ann)"]
