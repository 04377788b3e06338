"""Terms are read and written as SWI-Prolog reads and writes them."""

import os

import pytest
from swipl import SWIPL, asked, canonical
from written import random_terms, told, typed

from casper.kb.terms.syntax import term_text
from casper.kb.terms.writeq import writeq
from casper.kb.text.reader import read_term

TERMS = 10_000 if os.environ.get("HYPOTHESIS_PROFILE") == "thorough" else 500


@pytest.fixture(scope="module")
def answers(tmp_path_factory):
    """Random terms with how SWI-Prolog writes them, and whether it reads our text of them as the same."""
    if SWIPL is None:
        pytest.skip("swipl is not installed, so there is nothing to compare with")
    return [(term, pair) for term, *pair in told(TERMS, 20, tmp_path_factory.mktemp("swipl"))]


def test_writeq_writes_what_swi_prolog_writes(answers):
    assert [writeq(term) for term, _ in answers] == [written for _, (written, _) in answers]


def test_what_swi_prolog_writes_reads_in_as_the_term(answers):
    for term, (written, _) in answers:
        assert typed(read_term(written)) == typed(term), written


def test_swi_prolog_reads_our_text_of_a_term_as_the_term(answers):
    assert [(term_text(term, 1200), same) for term, (_, same) in answers if same != "same"] == []


@pytest.mark.parametrize("seed", range(20))
def test_a_term_is_the_same_after_it_was_written_and_read(seed):
    for term in random_terms(seed, 100):
        for text in (writeq(term), term_text(term, 1200), canonical(term).replace("'[|]'", "'.'")):
            assert typed(read_term(text)) == typed(term), text


TEXTS = [
    "- 1", "-1", "-(1)", "- (1)", "+1", "- a", "- - 1", "1 - -1", "a- - 1", "-(-)", "- = a", "[-]", "f(- , a)", "\\+a", "\\+ (a,b)",
    "-(a,b)", "1-(2-3)", "(a:-b)", "f((a:-b))", "(a,b,c)", "{a,b}", "[a,b|c]", "1e10", "1.0Inf0", "0x1F", "0b101", "0o17", "0'a", "0'\\n",
    "0'''", "0' ", "0'\\x41\\", "0'\\u00e9", "1_000", "16'ff", "-0.0", "- 0.0", "a:b:c", "(a->b;c)", '"a b"', "`ab`", "a=:=b", "a=..b",
    "X = 'is'", "'\\x41\\'", "'\\x41'", "'\\u00e9'", "'\\e\\s\\0\\'", "'\\101\\'", "'\\q'", "é", "Ünal", "食", "٣", "→→", "a→b", "f(dynamic)",
    "a=dynamic", "dynamic a", "a= \\+", "1 rdiv 2", "-2^2", "- 2^2", "-(2)^2", "-(2^2)", "- (1)^2", "2**3**4", "a^b^c", "a=b=c", "{}", "{}(a)",
    "'{}'(a,b)", "'hello'(x)", "hello (x)", "dynamic (a)", "a/*c*/b", "a /*c*/+b", "a '+' b", "'-' 1", "mod mod mod", "[a|b|c]",
    "[a,]", "f(a)(b)", "X(a)", "1e", "1_a", "\\+a=b", "p:-q,r;s", "a->b->c", "f(',')", "f(|)", "'a''b'", "\"a\"\"b\"", "a=\\+b", "$a", "f(;)",
    "(a;b)", "a:-b:-c", "- (x,y)", ":- a", "1 =\\= 2", "a xor b", "\\ a", "a @< b", "f(A,_B)", "[(a:-b)]", "2 - 1", "2 -1", "2-1", "a- 1", "f(- 1)",
]  # fmt: skip


def test_texts_are_read_as_swi_prolog_reads_them_or_refused_as_it_refuses_them(tmp_path):
    if SWIPL is None:
        pytest.skip("swipl is not installed, so there is nothing to compare with")
    ours = []
    for text in TEXTS:
        try:
            ours.append(read_term(text))
        except Exception:
            ours.append(None)
    told = asked([("none" if term is None else term, text) for term, text in zip(ours, TEXTS)], tmp_path)
    expected = ["error(syntax_error(" if term is None else "same" for term in ours]
    assert [(text, same) for text, same, (_, as_told) in zip(TEXTS, expected, told) if not as_told.startswith(same)] == []
