"""Large texts are read as the grammar would read them, place by place."""

import pytest
from hypothesis import given
from hypothesis import strategies as st
from programs import texts

from casper.kb import reader
from casper.kb.errors import ReadError

facts = st.sampled_from(["p(a).", "q( b ,12 ).", "r(a,b,c_1).  % done.", "p(1e5).", "p(1.5).", "p(is).", "q(a,\n  b).", "p(007)."])


def outcome(read, text):
    try:
        return [(s, s.place) for s in read(text, "f.pl")]
    except ReadError as mistake:
        return str(mistake)


@given(st.lists(st.one_of(facts, texts, st.sampled_from(["% note.\n", "/* p(x). */", "p(a", "p(b)."])), max_size=8).map("\n".join))
def test_a_large_text_is_read_as_the_grammar_reads_it(text):
    before, reader.LARGE = reader.LARGE, 0
    try:
        fast = outcome(reader.read_text, text)
    finally:
        reader.LARGE = before
    assert fast == outcome(reader._read_by_grammar, text)


def test_a_mistake_deep_in_a_large_text_is_told_with_its_place():
    text = "edge(a, b).\n" * 5000 + "edge(a b).\n" + "edge(a, b).\n" * 10
    with pytest.raises(ReadError) as told:
        reader.read_text(text, "big.pl")
    assert (told.value.place.line, told.value.place.column) == (5001, 8)
