"""Names and their roles, made of tokens; and places as editors count them."""

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from casper.kb.text.parsing.tokens import sentences_of
from casper.lsp.names import names_of
from casper.lsp.positions import Lines

ROLES = {
    "eat(A, plate) :- human(A), \\+ toy(plate), A \\= tiago.": [
        "head eat/2", "variable A", "data plate", "condition human/1", "variable A", "condition toy/1", "data plate", "variable A", "data tiago",
    ],
    "lunch(F) --> {meal(F)}, warm(F), optional((eat(F, plate), rest)).": [
        "plan lunch/1", "variable F", "condition meal/1", "variable F", "step warm/1", "variable F", "step optional/1", "step eat/2", "variable F", "data plate", "step rest/0",
    ],
    "never(\"no\") :- claim(eat(_, T, D)), did(eat(A, T, D), X), X > 3.": [
        "head never/1", "data no", "condition claim/1", "condition eat/3", "variable T", "variable D",
        "condition did/2", "condition eat/3", "variable A", "variable T", "variable D", "variable X", "variable X",
    ],
    "goal(lunch(F)) :- meal(F).": ["head goal/1", "step lunch/1", "variable F", "condition meal/1", "variable F"],
    "say(fr, eat(A, T), \"{A}\").": ["head say/3", "data fr", "condition eat/2", "variable A", "variable T", "data {A}"],
    "n(X) :- aggregate_all(count, cup(X), N), N = 2.": [
        "head n/1", "variable X", "condition aggregate_all/3", "data count", "condition cup/1", "variable X", "variable N", "variable N",
    ],
    "x --> by(robot, lift(T)), steps([a: go, b: put(T)], [a < b]).": None,
    "half(X, [a, b | T], f(": ["head half/3", "variable X", "data a", "data b", "variable T", "data f/0"],
}  # fmt: skip


@pytest.mark.parametrize("text", [text for text, roles in ROLES.items() if roles is not None])
def test_every_name_has_its_role(text):
    [tokens] = sentences_of(text)
    found = names_of(tokens)
    shown = [f"{n.role} {n.name}" + ("" if n.arity is None else f"/{n.arity}") for n in found]
    assert shown == ROLES[text]
    assert all(text[n.start : n.end].strip("'\"") == n.name for n in found)


def test_whose_step_it_is_is_no_step():
    [tokens] = sentences_of("x --> by(robot, lift(T)).")
    assert [(n.name, n.role) for n in names_of(tokens)] == [
        ("x", "plan"),
        ("by", "step"),
        ("robot", "data"),
        ("lift", "step"),
        ("T", "variable"),
    ]


@given(
    st.text(st.characters(exclude_categories=["Cs"]), max_size=40) | st.text("a\n\r😀é", max_size=20),
    st.sampled_from(["utf-8", "utf-16", "utf-32"]),
)
@settings(max_examples=60)
def test_a_place_leads_back_to_its_offset(text, encoding):
    lines = Lines(text, encoding)
    for offset in range(len(text) + 1):
        if not text[:offset].endswith("\r") and text[offset - 1 : offset + 1] != "\r\n":
            assert lines.offset(*lines.position(offset)) == offset


def test_columns_are_units_of_the_encoding():
    text = "é😀x"
    assert [Lines(text, each).position(2)[1] for each in ("utf-8", "utf-16", "utf-32")] == [6, 3, 2]
    assert Lines(text, "utf-16").offset(0, 99) == 3 and Lines(text, "utf-16").offset(9, 0) == 3
