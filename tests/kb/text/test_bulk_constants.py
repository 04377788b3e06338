"""Facts of constants of every kind become rows, and mean what the parser reads of them."""

import pytest
from hypothesis import example, given
from hypothesis import strategies as st
from test_bulk_facts import in_blocks
from test_bulk_reader import refuse, typed

from casper.kb.base import KnowledgeBase
from casper.kb.errors import ReadError
from casper.kb.text.bulk.facts import BlockReader
from casper.kb.text.bulk.reader import read_large
from casper.kb.text.reader import read_blocks, read_plainly
from casper.kb.text.writer import program_text

# --- what a fact may hold: constants, and what is nearly one ----------------------------------------------------------

INSIDE = ["a", "B ", ",", ", ", "(", ").", "%", "/*", ".", "\\n", "\\\\", "\\'", '\\"', "\\x41\\", "\\x41", "\\101\\", "\\u00e9"]
INSIDE += ["é", "\u2028", "日本", "`", "0'a", "\\e", "\\s", "_", "X", "\\\n", "\\c ", "\\q", "\\xd800\\", "\t"]
NUMBERS = ["0", "7", "007", "-7", "-0", "1.5", "-1.5e-3", "1.5E+3", "1e5", "-0.0", "0xff", "-0xFF", "0b101", "0o17", "1_000", "1_0_0"]
NUMBERS += ["0'a", "0''", "0',", "0'\\n", "16'ff", "1r3", "1.0Inf", "1.5NaN", "1e999", "9" * 120, "1" * 5000, "1.", "- 7", "+7", "--7", "1__0", "5is"]
NAMES = ["a", "cup", "is", "mod", "dynamic", "b_1", "éclair", "größe", "日本", "ñ2", "x²", "a·b", "Ünal", "ǅ", "X", "_", "_é", "[]", "{}", "!", "f(a)"]


def in_quotes(quote):
    inside = st.lists(st.sampled_from([*INSIDE, quote * 2]), max_size=4).map("".join)
    return inside.map(lambda text: f"{quote}{text}{quote}")


quoted = st.one_of(in_quotes("'"), in_quotes("'"), in_quotes('"'), in_quotes("`"))
constants = st.one_of(st.sampled_from(NUMBERS), st.sampled_from(NAMES), quoted, st.integers().map(str), st.floats(allow_nan=False).map(repr))
heads = st.one_of(st.sampled_from(["p", "p", "q", "größe", "'p'", '"p"', "'has part'", "':'", "'X'", "'it''s'"]), quoted)
facts = st.builds("{}({}).\n".format, heads, st.lists(constants, min_size=1, max_size=3).map(", ".join))
odd_texts = st.lists(st.one_of(facts, st.sampled_from(["p(a).\n", "q('a', -1).\n", "% 'a\n", "p(a):-q(a).\n"])), max_size=6).map("".join)
good = st.one_of(st.sampled_from(NUMBERS[:16]), st.sampled_from(NAMES[:9]), st.sampled_from(["'a,b'", "'it''s'", '"B)."', "'\\n'", "'日 本'"]))
good_facts = st.builds("{}({}).\n".format, st.sampled_from(["p", "'p'", "größe", "'has part'"]), st.lists(good, min_size=1, max_size=3).map(", ".join))
good_texts = st.lists(good_facts, min_size=1, max_size=6).map("".join)



def stated(sentences):
    """Each fact and rule with the first place it stands at, and every head with the types of its parts."""
    first = {}
    for sentence in sentences:
        first.setdefault(sentence, sentence.place)
    return first, {(sentence.head.indicator, typed(sentence.head)) for sentence in sentences}


def told(read, text):
    """What is stated, or the mistake with its place."""
    try:
        return stated(read(text))
    except ReadError as mistake:
        return str(mistake), mistake.place, mistake.excerpt


def through_blocks(text):
    sentences, blocks = in_blocks(text)
    everything = [*sentences, *(clause for block in blocks for clause in block.clauses())]
    return sorted(everything, key=lambda s: (s.place.line, s.place.column))


# --- laws -------------------------------------------------------------------------------------------------------------


@given(st.one_of(odd_texts, good_texts))
@example("p('a\\xd800\\').\np(a).\n")
@example("p(a, 0',).\n")
@example("p('a\\\nb', 1).\np(c, 2).\n")
@example("p(0'a').\np('b').\n")
@example("':'(a, b).\n")
def test_constants_of_every_kind_mean_what_the_parser_reads(text):
    assert told(through_blocks, text) == told(lambda t: read_plainly(t, "f.pl"), text)


@given(good_texts)
@example("p(-0.0, 1.5E+3, 0xff, 1_000, 'it''s', \"a, b).\", größe).\n")
def test_the_parser_is_not_asked_about_constants(text):
    long = text * (1 + 1_000 // len(text))
    blocks = BlockReader(long, "f.pl")
    assert read_large(long, "f.pl", refuse, blocks=blocks) == []
    assert sum(len(block.rows) for block in blocks.blocks()) == long.count("\n")


def test_a_run_that_only_the_parser_can_tell_of_is_looked_at_once(monkeypatch):
    looked = []
    take = BlockReader._take
    monkeypatch.setattr(BlockReader, "_take", lambda self, *span: looked.append(span) or take(self, *span))
    with pytest.raises(ReadError, match=r"^f.pl:1501:4: .q stands for nothing"):
        read_blocks("p('a').\n" * 1500 + "p('\\q').\n" + "p('a').\n" * 1500, "f.pl")
    assert len(looked) == 1


def test_a_fact_in_quotes_knows_its_place_and_is_printed_as_it_reads():
    kb = KnowledgeBase.from_text("".join(f"'has part'('Room {at}, (b).', -{at}.5).\n" for at in range(1500)), "big.pl")
    assert "[big.pl:8]" in str(kb.why("'has part'('Room 7, (b).', X)"))
    assert set(read_plainly(program_text(kb.clauses))) == set(kb.clauses)
