"""Printed lines: their text is what print shows, their roles change nothing of it."""

from hypothesis import given
from hypothesis import strategies as st

from casper.kb.text.lines import Span, bar, indented, line, lines_of, one_line, text_of

TEXTS = st.text()


@given(st.lists(st.lists(TEXTS)))
def test_the_text_of_lines_is_their_spans_one_after_the_other(rows):
    lines = [line(*(Span(text, "bad") if at % 2 else text for at, text in enumerate(row))) for row in rows]
    assert text_of(lines) == "\n".join("".join(row) for row in rows)


@given(TEXTS)
def test_a_text_is_the_text_of_its_lines(text):
    assert text_of(lines_of(text)) == text


def test_indented_lines_stand_further_to_the_right():
    assert text_of(indented(lines_of("a\n b"))) == "  a\n   b"


@given(TEXTS)
def test_what_a_repr_says_is_one_line_and_not_too_long(text):
    shown = one_line(text)
    assert len(shown.splitlines()) == 1
    assert len(shown) <= 162
    assert shown[1:-1] == text or len(text.splitlines()) != 1 or len(text) > 160 or text.splitlines() != [text]


@given(st.floats(0, 1), st.integers(1, 20))
def test_a_bar_is_as_wide_as_it_is_told_and_as_full_as_its_share(share, width):
    text, role = bar(share, width)
    assert (len(text), role) == (width, "share")
    assert abs(text.count("█") - share * width) <= 1


def test_half_a_share_is_half_a_bar():
    assert bar(0.5, 8).text == "████    "
    assert bar(0.53).text == "█████▎    "
