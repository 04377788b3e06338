"""Domains without a folder: from the texts that would stand in its files."""

import pickle

import pytest

from casper import CasperError, Domain

ONTOLOGY = "human(ann). robot(bot). cup(mug). boil(A) :- human(A). wash(A, C) :- robot(A), cup(C). wash(A, C) :- human(A), cup(C)."
PLANS = "tea --> boil, wash(mug)."


def test_a_domain_from_texts_verifies_and_explains():
    home = Domain.from_text(ontology=ONTOLOGY, plans=PLANS)
    reading = home.reading()
    reading.observe("boil")
    assert home.kb.ask("wash(bot, mug)") and reading.outcome == "tea"
    assert [str(step) for step in reading.plan_for("bot").actions] == ["wash(mug)"]


def test_without_an_ontology_it_only_explains():
    home = Domain.from_text(plans="tea --> boil, wash. soup --> cook.")
    reading = home.reading()
    reading.observe("cook")
    assert not home.verifies and reading.outcome == "soup"


def test_a_mistake_has_the_file_s_name_and_line():
    with pytest.raises(CasperError, match=r"^plans\.pl:2:"):
        Domain.from_text(plans="tea --> boil.\nsoup --> .")


def test_it_can_be_sent_elsewhere_and_is_shown():
    home = pickle.loads(pickle.dumps(Domain.from_text(ontology=ONTOLOGY, plans=PLANS, name="home")))
    assert home.name == "home" and "home" in repr(home) and home.kb.ask("boil(ann)")
