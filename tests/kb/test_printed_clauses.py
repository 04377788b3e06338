"""What is stated prints itself as text that reads in again; a large knowledge base says what there is."""

from casper import KnowledgeBase
from casper.kb.checks.check import check_text
from casper.kb.text.reader import read_text

TEXT = "cup('a:x:b').\nhot(X) :- cup(X), \\+ cold(X, _), X \\= mug.\ncold('[bold]', mug).\n"


def test_a_clause_a_production_and_a_directive_print_as_they_are_written():
    sentences = ["cup('a:x:b').", "hot(X) :- cup(X), \\+ cold(X, _).", "tea(C) --> fill(C), (sip ; drink(C)).", ":- dynamic(p / 1)."]
    assert [str(read_text(sentence)[0]) for sentence in sentences] == sentences


def test_a_condition_prints_as_it_stands_in_a_body():
    (rule,) = read_text("p(X) :- q(X, '[b]'), \\+ r(X), X < 3.")
    assert [str(condition) for condition in rule.body] == ["q(X, '[b]')", "\\+ r(X)", "X < 3"]


def test_a_small_knowledge_base_prints_its_clauses():
    kb = KnowledgeBase.from_text(TEXT)
    assert str(kb) == TEXT.rstrip()
    assert KnowledgeBase.from_text(str(kb)).clauses == kb.clauses


def test_a_large_one_prints_what_predicates_there_are():
    kb = KnowledgeBase.from_text("p(a). q(X, Y) :- p(X), p(Y).")
    kb.facts("n", [(number,) for number in range(100)])
    assert str(kb) == "102 clauses of 3 predicates: n/1, p/1, q/2"


def test_an_empty_one_says_so():
    assert str(KnowledgeBase()) == "% nothing is stated"


def test_facts_in_bulk_count_as_clauses():
    kb = KnowledgeBase.from_text("p(a).")
    kb.facts("n", [(number,) for number in range(100)])
    assert (len(kb), len(kb.clauses), repr(kb)) == (101, 101, "<KnowledgeBase: 101 clauses>")


def test_a_finding_prints_as_one_line_with_its_place():
    assert [str(f) for f in check_text("q(X, '[bold]') :- r([red], X).", "home.pl")][:1] == [
        "home.pl:1: error: nothing defines r/2; add a fact or a rule for it"
    ]
