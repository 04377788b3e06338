"""Runs of facts in a large text become rows: the same facts, with the same places, as clause by clause."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ProgramError, ReadError
from casper.kb.text import reader
from casper.kb.text.bulk import facts as bulk_facts
from casper.kb.text.reader import read_blocks, read_text
from casper.kb.text.writer import program_text

values = st.sampled_from(["a", "cup", "b_1", "0", "12", "007", "1.5", "0.25", "is"])
others = st.sampled_from(["X", "'a b'", "-3", "f(a)", "1e3", "[a]", "1_000", "9" * 16, "a  ", "é", "Ü"])
lines = st.builds("{}({}).\n".format, st.sampled_from(["p", "q", "edge"]), st.lists(values, min_size=1, max_size=3).map(", ".join))
odd = st.one_of(
    st.builds("{}({}).\n".format, st.sampled_from(["p", "q"]), others),
    st.sampled_from(["% p(a).\n", "\n", "  p(a).\n", "p(X) :- q(X).\n", "/* q(a).\n */", "p( a ).\n", "p(a). q(b).\n", "p(a,b).\n", "r.\n"]),
)
texts = st.lists(st.one_of(lines, lines, lines, odd), max_size=20).map("".join)


def in_blocks(text):
    """The sentences and blocks of a text, where every run of facts is worth a block."""
    before = reader.LARGE, bulk_facts._LEAST
    reader.LARGE, bulk_facts._LEAST = 0, 0
    try:
        return read_blocks(text, "f.pl")
    finally:
        reader.LARGE, bulk_facts._LEAST = before


def by_predicate(sentences):
    """The first clause of each kind with its place, by predicate, in order."""
    found = {}
    for s in sentences:
        if s.body or any("_" in repr(arg) and repr(arg)[0].isupper() for arg in s.head.args):
            found.setdefault("others", []).append((s, s.place))
        else:
            found.setdefault(s.head.indicator, {}).setdefault(s, s.place)
    return found


@given(texts)
def test_blocks_state_the_same_facts_at_the_same_places(text):
    sentences, blocks = in_blocks(text)
    everything = [*sentences, *(clause for block in blocks for clause in block.clauses())]
    everything.sort(key=lambda s: (s.place.line, s.place.column))
    expected = by_predicate(read_text(text, "f.pl"))
    assert by_predicate(everything) == expected
    typed = {(repr(s.head), *map(type, s.head.args)) for s in everything}
    assert typed == {(repr(s.head), *map(type, s.head.args)) for s in read_text(text, "f.pl")}


def test_a_long_run_is_one_block_a_predicate():
    text = "".join(f"edge(n{at}, n{at + 1}).\nsize(n{at}, {at}).\n" for at in range(2000))
    sentences, blocks = read_blocks(text)
    assert sentences == []
    assert [(block.indicator, len(block.rows)) for block in blocks] == [(("edge", 2), 2000), (("size", 2), 2000)]


LARGE_TEXT = "link(X, Y) :- edge(X, Y).\n" + "".join(f"edge(n{at}, n{at + 1}).\n" for at in range(2000))


def test_a_fact_of_a_block_knows_its_place_in_a_proof():
    kb = KnowledgeBase.from_text(LARGE_TEXT, "big.pl")
    assert "[given]   [big.pl:12]" in str(kb.why("link(n10, n11)"))
    assert str(kb.clauses_of(("edge", 2))[10].place) == "big.pl:12:1"


def test_a_base_of_blocks_is_the_base_of_their_clauses():
    kb = KnowledgeBase.from_text(LARGE_TEXT)
    assert len(kb) == len(read_text(LARGE_TEXT))
    again = KnowledgeBase()
    again.add(read_text(LARGE_TEXT))
    assert set(kb.clauses) == set(again.clauses)
    assert read_text(program_text(kb.clauses)) == list(kb.clauses)
    assert set(kb.rows("link", 2)) == set(again.rows("link", 2))


def test_a_fact_of_a_block_can_be_taken_back_and_given_again():
    kb = KnowledgeBase.from_text(LARGE_TEXT)
    assert kb.retract("edge(n5, n6)") and not kb.ask("link(n5, n6)")
    assert kb.assert_("edge(n5, n6)") and kb.ask("link(n5, n6)")
    assert not kb.assert_("edge(n5, n6)")
    assert not kb.assume("edge(n7, n9)", without=["edge(n7, n8)"]).ask("link(n7, n8)")


def test_facts_about_the_systems_names_are_told_with_their_place():
    with pytest.raises(ProgramError, match=r"^f.pl:1:1: claim/1 is defined by the system"):
        KnowledgeBase.from_text("claim(a).\n" * 3000, "f.pl")


def test_a_mistake_among_the_facts_is_told_with_its_place():
    with pytest.raises(ReadError, match=r"^big.pl:2003:8: 'b' does not belong here"):
        KnowledgeBase.from_text(LARGE_TEXT + "\nedge(a b).\n", "big.pl")
