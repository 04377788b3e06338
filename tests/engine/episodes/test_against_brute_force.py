"""A day against the enumeration of every derivation, where nothing is dropped."""

from __future__ import annotations

from math import isclose

from brute_force_day import derivations, posterior
from hypothesis import given
from hypothesis import strategies as st

from casper.engine.episodes.day import Day
from casper.engine.episodes.enumerated import Enumerated
from casper.engine.episodes.hypotheses.growth import Bounds
from casper.engine.episodes.prices import Prices
from casper.engine.reading.reading import nobody_can
from casper.engine.verification.matching import ParameterMatcher
from casper.plans.library import PlanLibrary

EVERYTHING = Bounds(keep=10**6, floor=0.0, entries=10**6, least=0.0, tries=10**9)
LEAF = st.sampled_from(["a", "b", "c", "d(X)", "d(cup)", "e(X)"])
ROW = st.lists(LEAF, min_size=1, max_size=3)
BODY = st.one_of(
    ROW.map(", ".join),
    st.tuples(ROW, ROW).map(lambda rows: f"unordered(({', '.join(rows[0])}), ({', '.join(rows[1])}))"),
    st.tuples(LEAF, LEAF, LEAF).map(lambda x: f"({x[0]} ; {x[1]}), {x[2]}"),
)
LIBRARIES = st.lists(BODY, min_size=1, max_size=3, unique=True).map(
    lambda bodies: PlanLibrary.from_text("\n".join(f"goal(g{n}).\ng{n} --> {b}." for n, b in enumerate(bodies)))
)
SEEN = st.sampled_from(["a", "b", "c", "d(cup)", "d(pot)", "e(cup)", "e(pot)"])
PRICES = st.sampled_from(
    [Prices(), Prices(begin=0.3, abandon=0.97, needless=0.2, missed=0.4, helping=0.3, settled=0.5)]
)
AGENTS = st.sampled_from([None, "ann", "bob"])


def growing_of(library):
    return Enumerated(library.ways, ParameterMatcher(library.ways), nobody_can)


def lived(library, prices, rows):
    day = Day(growing_of(library), prices, bounds=EVERYTHING)
    for action, agent in rows:
        day.observe(action, agent=agent)
    return day


def known(library, rows):
    """The observations whose actions the plans have, as the growing takes them."""
    day = Day(growing_of(library))
    names = [(action, agent) for action, agent in rows if not day._vocabulary.foreign(day._vocabulary.read(action))]
    return names, [(day._vocabulary.read(action), agent) for action, agent in names]


def agree(library, prices, rows):
    rows, seen = known(library, rows)
    if not rows:
        return
    day, growing = lived(library, prices, rows), growing_of(library)
    found = derivations(growing, prices, seen)
    whole = sum(derivation.weight for derivation in found)
    counts = {agent: [a for _, a in rows].count(agent) for _, agent in rows}
    assert day.is_exact
    for label, share in posterior(growing, prices, found, counts).items():
        assert isclose(day.posterior[label], share, rel_tol=1e-7, abs_tol=1e-12)
    agree_on_the_last(day, growing, found)
    agree_on_the_best(day, found, whole)


def agree_on_the_last(day, growing, found):
    whole = sum(derivation.then for derivation in found)
    shares = dict.fromkeys(growing.goals, 0.0)
    for derivation in found:
        if derivation.last is not None:
            shares[growing.goals[derivation.last]] += derivation.then / whole
    for label, share in shares.items():
        assert isclose(day.current[label], share, rel_tol=1e-7, abs_tol=1e-12)


def agree_on_the_best(day, found, whole):
    stories = {}
    for derivation in found:
        key = derivation.story, derivation.finished
        stories[key] = stories.get(key, 0.0) + derivation.weight / whole
    (story, _), heaviest = max(stories.items(), key=lambda pair: pair[1])
    account = max(day.best(10**6), key=lambda account: account.share_best)
    assert isclose(account.share_best, heaviest, rel_tol=1e-7)
    if sum(isclose(weight, heaviest, rel_tol=1e-6) for weight in stories.values()) == 1:
        told = {episode.observations for episode in account.episodes}
        numbers = {number for number in story if number is not None}
        assert told == {tuple(at + 1 for at, n in enumerate(story) if n == number) for number in numbers}
        assert [needless.number for needless in account.needless] == [
            at + 1 for at, number in enumerate(story) if number is None
        ]


@given(LIBRARIES, PRICES, st.lists(SEEN, min_size=1, max_size=5))
def test_one_partner(library, prices, actions):
    agree(library, prices, [(action, None) for action in actions])


@given(LIBRARIES, PRICES, st.lists(st.tuples(SEEN, AGENTS), min_size=1, max_size=4))
def test_several_partners(library, prices, rows):
    agree(library, prices, rows)


@given(LIBRARIES, st.lists(SEEN, min_size=1, max_size=6))
def test_probabilities_are_some(library, actions):
    rows, _ = known(library, [(action, None) for action in actions])
    day = lived(library, Prices(), rows)
    assert all(0 <= share <= 1 + 1e-9 for share in (*day.posterior.values(), *day.current.values()))
    assert sum(day.current.values()) <= 1 + 1e-9
