"""What nothing defines is declared in the text, so that facts may come later."""

from ontologies import imported


def test_a_class_that_conditions_need_and_nothing_gives_is_declared_once():
    text = imported("SubClassOf(:Dog :Animal)", "SubClassOf(:Dog :Pet)").files["ontology.pl"]
    assert [line for line in text.splitlines() if line.startswith(":- dynamic")] == [":- dynamic(dog/1)."]
