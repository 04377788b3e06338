"""What may have happened, judged: one observation that is not sure."""

import math

from hypothesis import given
from hypothesis import strategies as st

from casper import Domain
from casper.engine.verification.doubtful import judged
from casper.engine.verification.observation import Observation, Uncertain, options_of
from casper.engine.verification.verification import Statement, Verifier

KITCHEN = Domain.load("kitchen")
KNOWN = {name for name, _ in KITCHEN.library.actions}


def stated(action, target, place):
    return Statement(1.0, "human", action, target, place)


EAT, COOK, CARRY = stated("eat", "meal", "plate"), stated("cook", "meal", "hobs"), stated("pick_and_place", "meal", "plate")
NONSENSE = stated("eat", "bottle", "plate")


def told(chances):
    return judged(chances, Verifier(KITCHEN.kb), KNOWN)


def test_the_runner_up_is_not_forgotten():
    found = told({EAT: 0.6, CARRY: 0.3})
    assert isinstance(found.seen, Uncertain) and found.statement == EAT
    assert {str(option): round(share, 2) for option, share in found.seen.options} == {
        "eat(meal, plate)": 0.67,
        "pick_and_place(meal, plate)": 0.33,
    }


def test_what_cannot_be_leaves_the_rest_sure():
    assert told({NONSENSE: 0.7, COOK: 0.3}).seen == Observation("cook", ("meal", "hobs"))


def test_where_nothing_can_be_the_likeliest_is_refused_with_its_reasons():
    found = told({NONSENSE: 1.0})
    assert found.seen is None and found.verdict is not None and found.verdict.reasons


@given(st.dictionaries(st.sampled_from([EAT, COOK, CARRY, NONSENSE]), st.floats(0.001, 1.0), min_size=1))
def test_likelihoods_add_up(chances):
    seen = told(chances).seen
    assert seen is None or math.isclose(sum(share for _, share in options_of(seen)), 1.0, abs_tol=0.07)
