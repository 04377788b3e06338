"""Heads are matched with calls as unification says, and only what an older choice has to wipe is on the trail."""

from hypothesis import given
from hypothesis import strategies as st

from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.terms import Compound, Variable, make_list
from casper.kb.terms.unification import substitute, unify
from casper.kb.terms.values.effort import PARTS_A_STEP, charged_to
from casper.kb.top_down.compiled.cells import UNBOUND, Trail, freeze, inward, undo, variant
from casper.kb.top_down.compiled.code import CompiledClause
from casper.kb.top_down.compiled.unifying import occurs
from casper.kb.top_down.compiled.unifying import unify as unify_cells

OLD, TOP = 3, 7  # stamps: of a cell older than the newest choice, and of that choice


def terms_over(names):
    return st.recursive(
        st.sampled_from([*map(Variable, names), *map(Variable, names), "a", "b", 1]),
        lambda inner: st.one_of(
            st.builds(lambda x, y: Compound(("f", x, y)), inner, inner),
            st.builds(lambda x: Compound(("g", x)), inner),
            st.builds(lambda x, y, z: Compound(("h", x, y, z)), inner, inner, inner),
            st.builds(lambda x, depth: make_list(["a"] * depth, x), inner, st.sampled_from([19, 20, 21])),
        ),
        max_leaves=8,
    )


def matched(head, args, stamps=None):
    """The call's cells, the trail, and head and call as they are then; None in place of these where they differ."""
    clause = CompiledClause(Clause(head, (Literal(head),)))  # its body is the head, so that one sees what became of it
    call: dict = {}
    values = [inward(arg, call, OLD) for arg in args]
    for variable, stamp in (stamps or {}).items():
        call[variable][1] = stamp
    trail, frame = Trail(), [TOP, *values, *clause.blank]
    if not all(read(frame[slot], frame, trail, TOP) for slot, read in clause.matchers):
        return call, trail, None
    holes: dict = {}
    built = [freeze(value, holes) for value in clause.body.build(frame)]
    return call, trail, (built, [freeze(value, holes) for value in values])


@given(st.lists(terms_over("XYZ"), min_size=2, max_size=2), st.lists(terms_over("PQR"), min_size=2, max_size=2))
def test_a_head_agrees_with_a_call_where_unification_says_so_and_both_become_the_same(left, right):
    head, args = Compound(("p", *left)), Compound(("p", *right))
    call, trail, found = matched(head, args.args)
    bindings = unify(head, args, {})
    assert (found is None) == (bindings is None)
    if found is not None:
        expected = variant(substitute(head, bindings).args)
        assert [variant(part) for part in found] == [expected, expected]
    bound = [cell for cell in call.values() if cell[0] is not UNBOUND]
    assert all(any(cell is noted for noted in trail) for cell in bound)
    undo(trail, 0)
    assert all(cell[0] is UNBOUND for cell in call.values()) and not trail


@given(st.lists(terms_over("XYZ"), min_size=2, max_size=2), st.lists(terms_over("PQR"), min_size=2, max_size=2))
def test_what_is_younger_than_the_newest_choice_is_not_on_the_trail(left, right):
    variables = [v for v in map(Variable, "PQR") if v in Clause(Compound(("p", *right))).variables()]
    _, trail, _ = matched(Compound(("p", *left)), right, dict.fromkeys(variables, TOP))
    assert not trail


def test_a_binding_is_noted_where_the_cell_is_older_than_the_choice_alone():
    for stamp, noted in ((TOP - 1, 1), (TOP, 0)):
        for other in ("a", Compound(("f", "a", "b")), [UNBOUND, TOP]):
            trail = Trail()
            assert unify_cells([UNBOUND, stamp], other, trail, TOP) and len(trail) == noted


def test_looking_for_a_cell_in_a_large_term_is_charged_for_by_its_size():
    cell, other = [UNBOUND, OLD], [UNBOUND, OLD]
    term = ("f", "a", other)
    for _ in range(639):
        term = ("f", "a", term)
    told = []
    with charged_to(told.append):
        assert not occurs(cell, term)
    assert sum(told) == 640 // PARTS_A_STEP
    assert occurs(other, term)
