"""The first of equally good explanations, found without listing any, against listing all."""

from itertools import pairwise, product

from hypothesis import given
from hypothesis import strategies as st

from casper.engine.recognition.kernels.marks import first_marks

NAMES = st.lists(st.sampled_from("ab"), min_size=1, max_size=5)


def every_marking(leaves, seen):
    """Every way to give observations leaves of their names, from left to right, or to take them for needless (-1)."""
    for marks in product(range(-1, len(leaves)), repeat=len(seen)):
        marked = [leaf for leaf in marks if leaf >= 0]
        fits = all(leaf < 0 or leaves[leaf] == name for leaf, name in zip(marks, seen))
        if fits and marked and all(a < b for a, b in pairwise(marked)):
            yield marks


@given(NAMES, NAMES)
def test_the_first_marks_are_the_least_of_all_that_end_there_and_mark_as_many(leaves, seen):
    ends = {}
    for marks in every_marking(leaves, seen):
        key = (max(marks), sum(leaf >= 0 for leaf in marks))
        ends[key] = min(marks, ends.get(key, marks))
    for (last, marked), least in ends.items():
        assert first_marks(leaves, seen, last, marked) == least
