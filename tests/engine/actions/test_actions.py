import itertools
import json
import random

import pytest
from hypothesis import given
from hypothesis import strategies as st
from low_level_kitchen import GOLDEN, kitchen_rows, movements, rows_of

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.contexts import context_table, contextualise
from casper.engine.actions.fsm import likeliest_chain, movements_of, read_fsms, sampled_chain
from casper.engine.actions.prediction import ActionSettings, action_settings
from casper.engine.actions.ratcliff import similarity
from casper.engine.movements.movements import Movement
from casper.kb.errors import DomainError

GOLD = json.loads(GOLDEN.read_text())["letters"]
ROWS = kitchen_rows()
FSMS = {fsm.action: fsm for fsm in read_fsms(ROWS)}
RUNS = [(letters, name) for letters, runs in GOLD.items() for name in runs]


def ratcliff(**settings):
    return action_recogniser(ROWS, ActionSettings(recogniser="ratcliff", **settings))


def fed(recogniser, names, steps=1):
    """Every step's prediction."""
    names = [name for name in names for _ in range(steps)]
    return [recogniser.update(Movement(float(t), name)) for t, name in enumerate(names)]


# --- the paper's ensemble


@pytest.mark.parametrize(("letters", "name"), RUNS)
def test_the_curves_of_the_papers_figure_come_out_to_three_decimals(letters, name):
    recogniser, run = ratcliff(letters=letters), GOLD[letters][name]
    for t, (movement, scores) in enumerate(zip(run["movements"], run["scores"], strict=True)):
        recogniser.update(Movement(float(t), movement.lower()))
        assert {action: round(score, 3) for action, score in recogniser.scores.items()} == scores


@pytest.mark.parametrize(("letters", "name"), RUNS)
def test_the_winner_of_the_papers_figure_comes_out_at_its_step(letters, name):
    run = GOLD[letters][name]
    predictions = fed(ratcliff(letters=letters), [movement.lower() for movement in run["movements"]])
    first = next((step, p.action) for step, p in enumerate(predictions) if p is not None)
    assert first == (run["winner"]["step"], run["winner"]["action"])


def test_a_prediction_stands_until_accepted_and_is_fresh_once():
    recogniser = ratcliff()
    predictions = [p for p in fed(recogniser, movements("SWPTLP"), steps=3) if p is not None]
    assert {p.action for p in predictions} == {"pick_and_place"}
    assert [p.fresh for p in predictions] == [True] + [False] * (len(predictions) - 1)
    recogniser.accept()
    assert recogniser.window == () and recogniser.update(Movement(99.0, "pick")) is None


def test_a_rejected_prediction_leaves_the_window_as_it_is():
    recogniser = ratcliff()
    fed(recogniser, movements("SWPTL"), steps=3)
    before = recogniser.window
    recogniser.update(Movement(99.0, "place"))
    assert recogniser.window == before == tuple(movements("SWPTL"))


def test_drawn_chains_repeat_with_the_seed_and_after_a_reset():
    recogniser, other = ratcliff(mode="sample", seed=4), ratcliff(mode="sample", seed=4)
    runs = []
    for run in (recogniser, other, recogniser):
        run.reset()
        scores = []
        for t, name in enumerate(movements("SSWWPPTTLL")):
            run.update(Movement(float(t), name))
            scores.append(dict(run.scores))
        runs.append(scores)
    assert runs[0] == runs[1] == runs[2]


def test_the_mean_of_many_samples_varies_less_from_seed_to_seed_than_one_sample():
    def spread(mode):
        scores = []
        for seed in range(12):
            recogniser = ratcliff(mode=mode, seed=seed, samples=32)
            fed(recogniser, movements("SWPTL"), steps=3)
            scores.append(recogniser.scores["pick_and_place"])
        return max(scores) - min(scores)

    assert spread("mean") < spread("sample")


def test_similarity_is_not_symmetric_which_is_why_its_order_is_fixed():
    source = random.Random(1)
    pairs = [(source.choices("STPLW", k=6), source.choices("STPLW", k=6)) for _ in range(200)]
    assert any(similarity(a, b) != similarity(b, a) for a, b in pairs)


def test_the_sample_comes_first_in_the_comparison():
    window, chain = movements("SWTWTS"), likeliest_chain(FSMS["relocate"], "still", 6)
    recogniser = ratcliff(filter_window=1)
    fed(recogniser, window)
    assert recogniser.scores["relocate"] == similarity(chain, window) != similarity(window, chain)


@given(st.lists(st.sampled_from("SWTPL"), max_size=8), st.lists(st.sampled_from("SWTPL"), max_size=8))
def test_similarity_lies_between_zero_and_one_and_is_one_for_equals(a, b):
    assert 0 <= similarity(a, b) <= 1 == similarity(a, a)


# --- the chains


def test_the_likeliest_chain_takes_the_first_of_equals_in_the_table():
    assert likeliest_chain(FSMS["use"], "still", 6) == tuple(movements("SPLPLP"))


@pytest.mark.parametrize("action", FSMS)
def test_a_drawn_chain_only_makes_steps_the_table_has(action):
    fsm = FSMS[action]
    chain = sampled_chain(fsm, "still", 50, random.Random(2))
    assert len(chain) == 50 and all(b in fsm.rows[a] for a, b in itertools.pairwise(chain))


def test_every_row_of_the_kitchens_chains_adds_up_to_one():
    assert movements_of(tuple(FSMS.values())) == ("still", "walk", "transport", "pick", "place")
    assert all(sum(row.values()) == pytest.approx(1, abs=0.002) for f in FSMS.values() for row in f.rows.values())


@pytest.mark.parametrize(
    ("facts", "sentence"),
    [
        ([("a", "x", "x", 0.5)], "adds up to 0.5, not 1"),
        ([("a", "x", "y", 1)], "leads to y, which nothing leads from"),
        ([("a", "x", "x", 1.5)], "lies between 0 and 1"),
        ([("a", "x", "x", 1), ("a", "x", "x", 1)], "is there twice"),
    ],
)
def test_a_chain_that_is_none_is_refused_with_a_sentence(facts, sentence):
    with pytest.raises(DomainError, match=sentence):
        read_fsms(rows_of({("transition", 4): facts}))


# --- settings and context


def test_the_kitchen_recognises_by_hmm_and_keeps_the_papers_ensemble_at_hand():
    settings = action_settings(ROWS)
    assert (settings.recogniser, settings.length, settings.threshold) == ("hmm", 6, 0.7)


@pytest.mark.parametrize(
    ("name", "value"), [("recogniser", "oracle"), ("threshold", 7), ("confirm", 0), ("mode", "no")]
)
def test_a_setting_that_makes_no_sense_is_refused(name, value):
    with pytest.raises(DomainError, match=name):
        action_settings(rows_of({("setting", 3): [("actions", name, value)]}))


@pytest.mark.parametrize(
    ("destination", "meaning"),
    [
        ("sink", "wash"),
        ("hobs", "cook"),
        ("plate", "eat"),
        ("glass", "sip"),
        ("bottle", "sip"),
        ("meal", None),
        (None, None),
    ],
)
def test_use_means_what_its_destination_says_or_nothing(destination, meaning):
    assert contextualise("use", destination, context_table(ROWS)) == meaning


@pytest.mark.parametrize("destination", ["sink", None])
def test_an_action_that_needs_no_context_passes_through(destination):
    assert contextualise("pick_and_place", destination, context_table(ROWS)) == "pick_and_place"


def test_a_context_with_two_meanings_is_refused():
    with pytest.raises(DomainError, match="both wash and eat"):
        context_table(rows_of({("context", 3): [("use", "sink", "wash"), ("use", "sink", "eat")]}))
