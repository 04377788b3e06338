"""Random terms of three variables, as data and as kanren's."""

from hypothesis import strategies as st

from casper.kb.goals.minikanren import var

X, Y, Z = var("x"), var("y"), var("z")
NAMES = {"X": X, "Y": Y, "Z": Z}
terms = st.recursive(
    st.sampled_from(["X", "Y", "Z", "a", 1]), lambda inner: st.lists(inner, min_size=1, max_size=3).map(tuple), max_leaves=6
)


def theirs(term):
    return tuple(map(theirs, term)) if isinstance(term, tuple) else NAMES.get(term, term)
