"""One ontology in five syntaxes: the same text, the same answers, the same reasons; and so is its inconsistent twin."""

from functools import cache
from pathlib import Path

import pytest
from ontologies import broken, rows

from casper.kb.errors import ReadError
from casper.kb.ontologies.importing import import_ontologies

ZOO = Path(__file__).parent / "zoo"
SYNTAXES = ("ofn", "owx", "ttl", "nt", "rdf")
Z = "http://example.org/zoo#"
TWIN = {  # what makes it inconsistent: rex is a cat too, and ann has two ages
    "ofn": 'ClassAssertion(:Cat :rex)\nDataPropertyAssertion(:hasAge :ann "20"^^xsd:integer)\n',
    "owx": '<ClassAssertion><Class IRI="#Cat"/><NamedIndividual IRI="#rex"/></ClassAssertion>'
    '<DataPropertyAssertion><DataProperty IRI="#hasAge"/><NamedIndividual IRI="#ann"/>'
    '<Literal datatypeIRI="http://www.w3.org/2001/XMLSchema#integer">20</Literal></DataPropertyAssertion>',
    "ttl": ":rex a :Cat .\n:ann :hasAge 20 .\n",
    "nt": f"<{Z}rex> <http://www.w3.org/1999/02/22-rdf-syntax-ns#type> <{Z}Cat> .\n"
    f'<{Z}ann> <{Z}hasAge> "20"^^<http://www.w3.org/2001/XMLSchema#integer> .\n',
    "rdf": f'<rdf:Description rdf:about="{Z}rex"><rdf:type rdf:resource="{Z}Cat"/></rdf:Description>'
    f'<rdf:Description rdf:about="{Z}ann"><z:hasAge xmlns:z="{Z}" '
    'rdf:datatype="http://www.w3.org/2001/XMLSchema#integer">20</z:hasAge></rdf:Description>',
}
END = {"ofn": ")\n", "owx": "</Ontology>", "rdf": "</rdf:RDF>", "ttl": "", "nt": ""}


@cache
def zoo(syntax):
    return import_ontologies([ZOO / f"zoo.{syntax}"])


@cache
def base(syntax):
    return zoo(syntax).knowledge_base()


def twin(syntax, folder):
    text = (ZOO / f"zoo.{syntax}").read_text(encoding="utf-8").rstrip()
    end = END[syntax].rstrip()
    assert text.endswith(end)
    file = folder / f"twin.{syntax}"
    file.write_text(text[: len(text) - len(end)] + "\n" + TWIN[syntax] + end + "\n", encoding="utf-8")
    return file


@pytest.mark.parametrize("syntax", SYNTAXES[1:])
def test_every_syntax_gives_the_same_text(syntax):
    assert zoo(syntax).files == zoo("ofn").files


@pytest.mark.parametrize("syntax", SYNTAXES)
def test_it_answers(syntax):
    kb = base(syntax)
    assert broken(kb) == []
    assert rows(kb, "adult(X)") == [("ann",)]
    assert rows(kb, "years_to_go(X, Y)") == [("bob", 6), ("bobby", 6)]
    assert rows(kb, "has_ancestor(ann, X)") == [("carl",), ("dora",)]
    assert rows(kb, "has_uncle(ann, X)") == [("emil",)]
    assert kb.ask("pet_owner(ann)") and not kb.ask("pet_owner(bob)")


@pytest.mark.parametrize("syntax", SYNTAXES)
def test_a_proof_shows_the_axiom_behind_each_step(syntax):
    shown = str(base(syntax).why("pet_owner(ann)"))
    assert "[PetOwner EquivalentTo Person and (hasPet some Animal)]" in shown
    assert "[hasPet InverseOf isPetOf]" in shown
    assert "[Dog SubClassOf Animal]" in shown
    assert base(syntax).why("adult(ann)").to_json()["cites"].startswith("who is 18 is an adult: Person(?p), hasAge")


@pytest.mark.parametrize("syntax", SYNTAXES)
def test_the_inconsistent_twin_names_the_axioms_that_clash_and_the_facts(syntax, tmp_path):
    imported = import_ontologies([twin(syntax, tmp_path)])
    kb = imported.knowledge_base()
    assert broken(kb) == ["Cat DisjointWith Dog", "FunctionalProperty(hasAge)"]
    assert [str(x.atom) for x in kb.broken()[0].clash] == ["cat(rex)", "dog(rex)"]
    assert kb.verify("person(ann)").valid is False
    assert "Cat DisjointWith Dog" in kb.verify("person(ann)").reasons
    told = [f for f in imported.write(tmp_path / "out") if f.severity == "error"]
    assert [f.message for f in told] == [
        "the ontology contradicts itself: Cat DisjointWith Dog (cat(rex), dog(rex))",
        "the ontology contradicts itself: FunctionalProperty(hasAge) (has_age(ann, 19), has_age(ann, 20))",
    ]


@pytest.mark.parametrize("syntax", SYNTAXES)
def test_what_no_rule_can_say_is_listed_with_its_file_and_line(syntax):
    told = [f for f in zoo(syntax).findings if f.severity == "warning"]
    assert sorted(f.message.partition(":")[0] for f in told) == [
        "Parent SubClassOf inverse(hasParent) some Person",
        "PetOwner EquivalentTo Person and (hasPet some Animal)",
    ]
    assert {Path(f.place.file).name for f in told} == {f"zoo.{syntax}"}
    assert all(f.place.line for f in told) == (syntax in ("ofn", "owx"))


@pytest.mark.parametrize("syntax", SYNTAXES)
@pytest.mark.parametrize("share", [0.1, 0.35, 0.5, 0.8])
def test_a_truncated_file_is_told_with_its_line_and_what_to_do(syntax, share, tmp_path):
    content = (ZOO / f"zoo.{syntax}").read_bytes()
    cut = content[: int(len(content) * share)]
    if syntax in ("ttl", "nt"):
        cut = cut[: cut.rstrip().rfind(b"\n")] + b"\n<http://z.org/a> <http://z.org/b"
    file = tmp_path / f"cut.{syntax}"
    file.write_bytes(cut)
    with pytest.raises(ReadError) as told:
        import_ontologies([file])
    assert told.value.place.file == str(file)
    assert told.value.place.line == len(cut.rstrip().split(b"\n"))
    assert "cut short; get the whole file" in told.value.sentence


def test_an_owl_file_may_be_in_any_syntax(tmp_path):
    for syntax in ("ofn", "owx", "ttl", "rdf"):
        file = tmp_path / f"{syntax}.owl"
        file.write_bytes((ZOO / f"zoo.{syntax}").read_bytes())
        assert import_ontologies([file]).files == zoo("ofn").files


def test_several_files_are_one_ontology(tmp_path):
    (tmp_path / "a.ttl").write_text("@prefix : <http://z.org/> . :Dog <http://www.w3.org/2000/01/rdf-schema#subClassOf> :Animal .")
    (tmp_path / "b.ttl").write_text("@prefix : <http://z.org/> . :rex a :Dog .")
    assert import_ontologies([tmp_path / "a.ttl", tmp_path / "b.ttl"]).knowledge_base().ask("animal(rex)")


def test_an_import_that_was_not_given_is_told(tmp_path):
    (tmp_path / "a.ofn").write_text("Ontology(<http://z.org/a>\nImport(<http://z.org/b>)\nSubClassOf(<http://z.org/#A> <http://z.org/#B>))")
    (tmp_path / "b.ofn").write_text("Ontology(<http://z.org/b>\nSubClassOf(<http://z.org/#B> <http://z.org/#C>))")
    (told,) = import_ontologies([tmp_path / "a.ofn"]).findings
    assert (told.place.line, told.message) == (2, "the ontology needs http://z.org/b, which was not read; give its file, too")
    assert import_ontologies([tmp_path / "a.ofn", tmp_path / "b.ofn"]).findings == []
