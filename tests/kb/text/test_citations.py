"""A comment ``%: …`` behind a clause is where it comes from."""

import pytest

from casper import KnowledgeBase
from casper.kb.text.reader import read_text

TEXT = """human(ann).
agent(X) :- human(X).  %: Human SubClassOf Agent
helper(X) :- agent(X).  % a plain comment
never("50 %: is too much") :- human(bob).
eager(X) :-
    helper(X).
"""


@pytest.mark.parametrize("padding", ["", "% padding\n" * 3000], ids=["small", "large"])
def test_a_clause_has_the_citation_on_its_line(padding):
    cited = [sentence.place.citation for sentence in read_text(padding + TEXT)]
    assert cited == ["", "Human SubClassOf Agent", "", "", ""]


def test_proofs_show_it_as_text_and_as_json():
    proof = KnowledgeBase.from_text(TEXT, "home.pl").why("agent(ann)")
    assert str(proof).splitlines()[0] == "agent(ann)   [home.pl:2]   [Human SubClassOf Agent]"
    assert proof.to_json()["cites"] == "Human SubClassOf Agent"
    assert "cites" not in proof.to_json()["because"][0]


def test_it_makes_no_difference_between_clauses():
    assert set(read_text("p(X) :- q(X).  %: one")) == set(read_text("p(X) :- q(X).  %: two"))
