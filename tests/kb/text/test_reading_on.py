"""Reading on after mistakes: where each is, what is shown of it, and what of the rest is read."""

import pytest

from casper.kb.text.reader import read_text
from casper.kb.text.recovery import read_tolerantly


def shown(text):
    return [(mistake.place.line, mistake.place.column, mistake.excerpt) for mistake in read_tolerantly(text, "t.pl").mistakes]


def test_a_mistake_is_shown_with_its_whole_line_and_a_caret_under_it():
    assert shown("p(a).\nq(a). r(b c). s(d).\nt(e).\n") == [(2, 11, "    q(a). r(b c). s(d).\n              ^")]


def test_a_mistake_at_the_end_is_shown_with_the_last_line():
    ((line, _, excerpt),) = shown("p(a).\nq(b")
    assert line == 2 and excerpt.startswith("    q(b\n")


@pytest.mark.parametrize(
    ("text", "read", "lines"),
    [
        ("p(a).\nq(b c).\nr(d).", "p(a). r(d).", [2]),
        ("p(a)\nq(b).\nr(c)\ns(d).", "p(a). q(b). r(c). s(d).", [2, 4]),
        ("p('a. b'). q(\"c. d\"). r(e f). s(g).", "p('a. b'). q(\"c. d\"). s(g).", [1]),
        ("p(1.5). q(x y). r(2.5).", "p(1.5). r(2.5).", [1]),
        ("p(a). % q(b c).\n/* r(d e). */ s(f g). t(h).", "p(a). t(h).", [2]),
        ("p(a b). q(c d).", "", [1, 1]),
    ],
)
def test_every_clause_that_can_be_read_is_read(text, read, lines):
    found = read_tolerantly(text, "t.pl")
    assert found.sentences == (read_text(read) if read else [])
    assert [mistake.place.line for mistake in found.mistakes] == lines


def test_unreadable_clauses_tell_what_they_seem_to_be_about():
    assert read_tolerantly("p(a). /* about q */ q(b c).\n% r\nr(d e). X y.").half_read == {"q", "r"}


def test_clauses_in_the_same_block_as_a_mistake_keep_their_places():
    text = "\n".join(f"p({n})." for n in range(450)) + "\nq(a b).\n" + "\n".join(f"r({n})." for n in range(450))
    found = read_tolerantly(text, "t.pl")
    assert len(found.sentences) == 900
    assert [s.place.line for s in found.sentences] == [*range(1, 451), *range(452, 902)]
    assert [m.place.line for m in found.mistakes] == [451]


def test_a_text_that_is_nested_too_deeply_is_one_mistake():
    (mistake,) = read_tolerantly("p(" + "f(" * 100_000 + "a" + ")" * 100_001 + ".").mistakes
    assert "nested too deeply" in mistake.sentence
