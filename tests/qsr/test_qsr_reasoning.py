"""The algebra of the calculi: its laws, its tables against sampled geometry, and what can hold at once."""

import itertools

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from casper import qsr
from casper.kb.errors import BudgetExceeded, TraceError
from casper.qsr.plain.directions import CARDINAL, cone, projection
from casper.qsr.reasoning.table import ALGEBRAS

SMALL = [name for name in ALGEBRAS if name not in ("qtc_c", "rectangle")]
FEW = settings(max_examples=25)


@pytest.mark.parametrize("name", list(ALGEBRAS))
def test_turning_twice_changes_nothing_and_turns_neighbours_into_neighbours(name):
    a = qsr.algebra(name)
    for r in a.relations:
        assert a.converse(a.converse(r)) == {r}
        assert a.converse(a.neighbours(r)) == a.neighbours(*a.converse(r)) and r not in a.neighbours(r)
        assert all(r in a.neighbours(s) for s in a.neighbours(r))


@pytest.mark.parametrize("name", SMALL)
def test_the_converse_of_a_composition_is_the_composition_of_converses_backwards(name):
    a = qsr.algebra(name)
    for r, s in itertools.product(a.relations, repeat=2):
        assert a.converse(a.compose(r, s)) == a.compose(a.converse(s), a.converse(r))


@pytest.mark.parametrize("name", SMALL)
def test_compositions_may_be_taken_in_any_order(name):
    a = qsr.algebra(name)
    one = [1 << n for n in range(len(a.relations))]
    for r, s, t in itertools.product(one, repeat=3):
        assert a.joined(a.joined(r, s), t) == a.joined(r, a.joined(s, t))


@pytest.mark.parametrize("name", [name for name in ALGEBRAS if qsr.algebra(name).identity is not None])
def test_by_way_of_what_is_the_same_nothing_changes(name):
    a = qsr.algebra(name)
    same = a.relations[a.identity]
    assert all(
        a.compose(r, same) == a.compose(same, r) == {r} and same in a.compose(r, a.converse(r)) for r in a.relations
    )


def triples(codes, count):
    """Which third relation was seen by each first and second: codes (n, n) of things to things."""
    found = np.zeros((count, count, count), dtype=bool)
    for middle in range(len(codes)):
        found[codes[:, middle, None], codes[None, middle, :], codes] = True
    return found


def table(a):
    n = len(a.relations)
    return np.array([[[bool(a.composed[r][s] >> t & 1) for t in range(n)] for s in range(n)] for r in range(n)])


def regions_of_a_line(cells):
    """RCC8 between all regions that are made of some cells of a line."""
    regions = [{c for c in range(cells) if mask >> c & 1} for mask in range(1, 1 << cells)]

    def wide(region):
        return {c + step for c in region for step in (-1, 0, 1)}

    def told(one, other):
        if one == other:
            return "eq"
        if not one & other:
            return "ec" if wide(one) & other else "dc"
        if one < other:
            return "ntpp" if wide(one) <= other else "tpp"
        if one > other:
            return "ntppi" if wide(other) <= one else "tppi"
        return "po"

    place = qsr.algebra("rcc8").place
    return np.array([[place[told(one, other)] for other in regions] for one in regions])


def test_rcc8_composes_as_regions_of_a_line_do_and_no_further():
    assert (triples(regions_of_a_line(7), 8) == table(qsr.algebra("rcc8"))).all()


@pytest.mark.parametrize(("name", "told", "wide"), [("cardinal", projection, 4), ("cone", cone, 7)])
def test_cardinal_directions_compose_as_points_of_a_grid_do_and_no_further(name, told, wide):
    points = list(itertools.product(range(wide), repeat=2))
    codes = np.array([[told(a[0] - b[0], a[1] - b[1]) for b in points] for a in points])
    order = np.array([CARDINAL.index(relation) for relation in qsr.algebra(name).relations])
    found = triples(codes, 9)[np.ix_(order, order, order)]
    assert (found == table(qsr.algebra(name))).all()


def motions(places, moves, name, **settings):
    """Codes of QTC between all states (place, move) of things whose places differ."""
    states = [(p, m) for p in places for m in moves]
    names = [f"s{n}" for n in range(len(states))]
    before, after = ([s[0] for s in states], [tuple(np.add(*s)) for s in states])
    made = qsr.relations(
        qsr.Trace.of((0, 1), names, [before, after]), {"qtc_b": qsr.QtcB, "qtc_c": qsr.QtcC}[name](qsr.Distance(0))
    )
    codes = np.zeros((len(states),) * 2, dtype=int)
    place = {n: i for i, n in enumerate(names)}
    for row, code in zip(made[name].of, made[name].codes[:, 1]):
        codes[place[row[0]], place[row[1]]] = code
    apart = np.array([[a[0] != b[0] for b in states] for a in states])
    return codes, apart


def apart_triples(codes, apart, count):
    found = np.zeros((count, count, count), dtype=bool)
    for middle in range(len(codes)):
        one, other = np.nonzero(apart[:, middle, None] & apart[None, middle, :] & apart)
        found[codes[one, middle], codes[middle, other], codes[one, other]] = True
    return found


STEPS = list(itertools.product((-1, 0, 1), repeat=2))


def test_qtc_b_in_the_plane_composes_to_anything():
    codes, apart = motions([(0, 0), (4, 0), (2, 2), (0, 4), (4, 4), (2, -2)], STEPS, "qtc_b")
    assert (apart_triples(codes, apart, 9) == table(qsr.algebra("qtc_b"))).all()


def test_qtc_b_on_a_line_composes_as_three_on_a_line_do_and_no_further():
    codes, apart = motions([(x, 0) for x in (0, 4, 8)], [(-1, 0), (0, 0), (1, 0)], "qtc_b")
    assert (apart_triples(codes, apart, 9) == table(qsr.algebra("qtc_b_line"))).all()


def test_no_motion_in_the_plane_is_ruled_out_by_the_composition_of_qtc_c():
    codes, apart = motions([(0, 0), (4, 0), (1, 3), (5, 2)], STEPS, "qtc_c")
    a = qsr.algebra("qtc_c")
    for middle in range(len(codes)):
        one, other = np.nonzero(apart[:, middle, None] & apart[None, middle, :] & apart)
        seen = set(zip(codes[one, middle].tolist(), codes[middle, other].tolist(), codes[one, other].tolist()))
        assert all(a.composed[r][s] >> t & 1 for r, s, t in seen)


spans = st.tuples(st.integers(0, 6), st.integers(1, 3)).map(lambda s: (s[0], s[0] + s[1]))


@given(st.lists(st.tuples(spans, spans), min_size=3, max_size=3))
def test_no_three_rectangles_are_ruled_out_by_the_composition_of_rectangle_algebra(boxes):
    stream = qsr.Stream("rectangle", "rcc8")
    bodies = {
        name: qsr.Body((x0 + x1) / 2, (y0 + y1) / 2, size=(x1 - x0, y1 - y0))
        for name, ((x0, x1), (y0, y1)) in zip("abc", boxes)
    }
    for name, told in stream.update(0, bodies).items():
        assert told["a", "c"] in qsr.algebra(name).compose(told["a", "b"], told["b", "c"])


def test_allens_table_has_the_409_entries_of_the_published_one():
    assert (
        sum(
            len(qsr.algebra("allen").compose(r, s))
            for r in qsr.algebra("allen").relations
            for s in qsr.algebra("allen").relations
        )
        == 409
    )
    assert qsr.algebra("allen").compose("during", "overlaps") == {"before", "meets", "overlaps", "starts", "during"}


def test_one_end_at_a_time_comes_to_or_leaves_another():
    a = qsr.algebra("allen")
    assert a.neighbours("before") == {"meets"} and a.neighbours("equals") == {
        "starts",
        "started_by",
        "finishes",
        "finished_by",
    }
    assert sum(len(a.neighbours(r)) for r in a.relations) == 2 * 16


@FEW
@given(
    st.lists(st.tuples(st.integers(-9, 9), st.integers(-9, 9)), min_size=2, max_size=2, unique=True),
    st.sampled_from(STEPS),
)
def test_directions_of_things_that_move_steadily_change_to_neighbours(points, move):
    (ax, ay), (bx, by) = points
    for name, told, fine in (("cardinal", projection, 64), ("cone", cone, 64)):
        relations = []
        for at in range(10 * fine):
            code = told(ax + move[0] * at / fine - bx, ay + move[1] * at / fine - by)
            relations.append(CARDINAL[code])
        for one, other in itertools.pairwise(relations):
            assert one == other or other in qsr.algebra(name).neighbours(one)


def test_a_contradiction_names_three_things():
    network = qsr.Network(qsr.algebra("allen"))
    network.add("breakfast", "before", "work")
    network.add("work", ("before", "meets"), "lunch")
    network.add("lunch", "before", "breakfast")
    assert str(network.close()) == "lunch is before breakfast, but by way of work it can only be after"


def test_closing_draws_conclusions():
    network = qsr.Network(qsr.algebra("rcc8"))
    network.add("cup", "ntpp", "tray")
    network.add("tray", ("tpp", "eq"), "table")
    assert network.close() is None
    assert network.between("cup", "table") == {"ntpp"} and network.between("table", "cup") == {"ntppi"}
    assert repr(network) == "<Network of 3 things in rcc8>"


def test_what_is_said_twice_must_hold_twice():
    network = qsr.Network(qsr.algebra("cardinal"))
    network.add("a", ("n", "ne"), "b")
    network.add("b", ("s", "w"), "a")
    assert network.between("a", "b") == {"n"}
    network.add("a", "w", "b")
    assert network.close() is not None


@FEW
@given(st.sampled_from(["allen", "cardinal", "rcc8"]), st.data())
def test_what_happened_is_never_a_contradiction_and_stays_possible(name, data):
    numbers = np.random.default_rng(data.draw(st.integers(0, 10**6)))
    a, things = qsr.algebra(name), "abcde"
    stream = qsr.Stream({"allen": "rectangle", "cardinal": qsr.Cardinal("projection"), "rcc8": "rcc8"}[name])
    bodies = {n: qsr.Body(*numbers.integers(0, 6, 2), size=tuple(numbers.integers(1, 4, 2))) for n in things}
    told = {row: label.split(",")[0] for row, label in next(iter(stream.update(0, bodies).values())).items()}
    network = qsr.Network(a)
    for one, other in itertools.combinations(things, 2):
        if numbers.random() < 0.6:
            vague = {told[one, other], *numbers.choice(a.relations, 2)}
            network.add(one, [str(relation) for relation in vague], other)
    assert network.close() is None
    assert all(told[row] in network.between(*row) for row in told)
    found = network.scenario()
    assert found is not None and found.close() is None
    assert all(len(found.between(*row)) == 1 for row in itertools.combinations(network.things, 2))


def test_a_search_says_when_it_does_not_know():
    network = qsr.Network(qsr.algebra("allen"))
    for n in range(6):
        network.add(f"i{n}", ("before", "after"), f"i{n + 1}")
    with pytest.raises(BudgetExceeded, match="stopped at its budget"):
        network.scenario(budget=2)
    assert network.scenario() is not None


def test_a_path_consistent_network_may_have_no_scenario():
    network = qsr.Network(qsr.algebra("allen"))
    network.add("a", ("before", "meets"), "b")
    network.add("b", "before", "a")
    assert network.scenario() is None


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: qsr.algebra("rcc7"), "there is no algebra 'rcc7'; there are allen, point"),
        (lambda: qsr.algebra("allen").compose("before", "soon"), "'soon' is no relation of allen; there are before"),
        (
            lambda: qsr.Network(qsr.algebra("allen")).add("a", "before", "a"),
            "a is related to itself, and cannot be before",
        ),
        (lambda: qsr.Network(qsr.algebra("qtc_b")).add("a", "00", "a"), "a is related to itself"),
    ],
)
def test_reasoning_about_nonsense_is_refused_in_a_sentence(make, sentence):
    with pytest.raises(TraceError, match=sentence):
        make()
