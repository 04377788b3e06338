"""Whatever text there is, it is read, and printed as what reads in again as the same, or refused in words."""

from hypothesis import given
from hypothesis import strategies as st
from programs import texts

from casper.kb.errors import ReadError
from casper.kb.text.reader import read_text
from casper.kb.text.writer import program_text

_BASICS = ["a", "bob", "é", "Ü", "X", "_", "_Y", "0", "12", "-3", "1.5", "0'a", "0xf", "'A b'", '"s. "', "''", "[]", "{}", "`x`", "!", "+", "=..", "is", "dynamic"]
_INFIX = [",", ";", "->", ":-", "|", "=", "\\=", "is", "<", "=:=", "@<", "=..", ":", "+", "-", "*", "/", "//", "mod", "xor", ">>", "/\\", "**", "^", "-->"]
_GAPS = ["", " ", "\n", " % c\n", " /* c */ "]


def _deeper(inner):
    spaced = st.sampled_from(_GAPS)
    arguments = st.lists(inner, min_size=1, max_size=3).map(",".join)
    return st.one_of(
        st.builds("{}{}{} {}{}".format, inner, spaced, st.sampled_from(_INFIX), spaced, inner),
        st.builds("{}{}{}".format, st.sampled_from(["-", "+", "\\+", "\\", "?-", "table"]), spaced, inner),
        st.builds("{}({})".format, st.sampled_from(["p", "'Q r'", "-", "\\+", "é", "optional"]), arguments),
        st.builds("({}{})".format, spaced, inner),
        st.builds("{{{}}}".format, inner),
        st.builds("[{}]".format, arguments),
        st.builds("[{}|{}]".format, arguments, inner),
    )


_spelled = st.recursive(st.sampled_from(_BASICS), _deeper, max_leaves=10)


@given(_spelled)
def test_whatever_can_be_spelled_is_read_or_refused_in_words(body):
    for text in (f"p :- {body}\n.", f"p --> {body}\n.", f":- {body}\n.", f"p(({body}\n)).", f"{body} ."):
        try:
            sentences = read_text(text)
        except ReadError as mistake:
            assert mistake.place.line >= 1 and mistake.place.column >= 1 and mistake.excerpt
            continue
        assert read_text(program_text(sentences)) == sentences


@given(st.text(st.sampled_from(list("pXq_0x('\"`[]{}),.;|\\+-:=<> %/*\n!éÜ→\u0301")), max_size=30))
def test_any_text_is_read_or_refused_in_words(text):
    try:
        sentences = read_text(text)
    except ReadError as mistake:
        assert mistake.place.line >= 1 and mistake.place.column >= 1
        return
    assert read_text(program_text(sentences)) == sentences


@given(texts)
def test_what_is_printed_reads_in_again_as_the_same(text):
    try:
        sentences = read_text(text)
    except ReadError:  # a body may hold what is no condition
        return
    printed = program_text(sentences)
    assert read_text(printed) == sentences
    assert program_text(read_text(printed)) == printed
