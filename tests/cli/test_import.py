"""``casper import``: files in, a folder of text out, and what no rule can say as findings."""

from pathlib import Path

import pytest

ZOO = Path(__file__).parent.parent / "kb" / "ontologies" / "zoo"
TURTLE = "@prefix : <http://z.org/> . @prefix rdfs: <http://www.w3.org/2000/01/rdf-schema#> . @prefix owl: <http://www.w3.org/2002/07/owl#> .\n"


def test_the_text_is_a_domain_that_verifies_and_explains(casper, tmp_path):
    assert casper("import", str(ZOO / "zoo.ttl"), str(tmp_path / "zoo")).code == 0
    told = casper("verify", str(tmp_path / "zoo"), "pet_owner(ann)")
    assert told.code == 0
    assert "[PetOwner EquivalentTo Person and (hasPet some Animal)]" in told.out
    assert casper("query", str(tmp_path / "zoo"), "has_uncle(X, Y)", "--json").json == [{"X": "ann", "Y": "emil"}]
    assert casper("check", str(tmp_path / "zoo")).code == 0


def test_what_is_beyond_rules_is_one_json_object_each(casper, tmp_path):
    told = casper("import", str(ZOO / "zoo.ofn"), str(tmp_path / "zoo"), "--json")
    assert told.code == 0
    assert {(x["line"], x["severity"]) for x in told.json} == {(35, "warning"), (36, "warning")}
    assert all(x["file"].endswith("zoo.ofn") and x["message"] for x in told.json)


def test_an_ontology_that_contradicts_itself_is_exit_code_1_and_check_shows_the_facts(casper, tmp_path):
    (tmp_path / "zoo.ttl").write_text(TURTLE + ":Cat owl:disjointWith :Dog . :Kitten rdfs:subClassOf :Cat . :Unborn rdfs:subClassOf :Dog . :rex a :Dog, :Kitten .")
    told = casper("import", str(tmp_path / "zoo.ttl"), str(tmp_path / "zoo"), "--json")
    assert told.code == 1
    (error,) = [x for x in told.json if x["severity"] == "error"]
    assert error["message"] == "the ontology contradicts itself: Cat DisjointWith Dog (cat(rex), dog(rex))"
    assert (tmp_path / "zoo" / "ontology.pl").read_text().splitlines()[error["line"] - 1].startswith('never("Cat DisjointWith Dog")')
    checked = casper("check", str(tmp_path / "zoo"))
    assert checked.code == 1
    assert 'the facts break "Cat DisjointWith Dog": kitten(rex)' in checked.out


def test_a_truncated_file_is_exit_code_2_with_its_line(casper, tmp_path):
    (tmp_path / "zoo.ofn").write_text("Ontology(<http://z.org>\nSubClassOf(<http://z.org/A>")
    told = casper("import", str(tmp_path / "zoo.ofn"), str(tmp_path / "zoo"))
    assert told.code == 2
    assert told.err == f"casper: {tmp_path}/zoo.ofn:2: the file ends here, in the middle of the ontology: it was cut short; get the whole file\n"
    assert not (tmp_path / "zoo").exists()


def test_a_text_that_is_there_already_is_not_written_over_unless_told_to(casper, tmp_path):
    arguments = ("import", str(ZOO / "zoo.nt"), str(tmp_path))
    (tmp_path / "ontology.pl").write_text("mine(x).\n")
    told = casper(*arguments)
    assert told.code == 2 and "is there already" in told.err
    assert (tmp_path / "ontology.pl").read_text() == "mine(x).\n"
    assert casper(*arguments, "--replace").code == 0


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("zoo",), "there is nothing to import"),
        (("zoo.pdf", "zoo"), "is no ontology by its name"),
        (("zoo.ttl", "zoo"), "cannot read"),
    ],
)
def test_mistakes_are_one_sentence_and_exit_code_2(casper, tmp_path, monkeypatch, arguments, told):
    monkeypatch.chdir(tmp_path)
    said = casper("import", *arguments)
    assert said.code == 2 and told in said.err and len(said.err.splitlines()) == 1


def test_without_rdflib_the_command_that_brings_it_is_told(casper, tmp_path, monkeypatch):
    from importlib import util

    known = util.find_spec
    monkeypatch.setattr("casper.cli.terminal.extras.find_spec", lambda name: None if name == "rdflib" else known(name))
    told = casper("import", str(ZOO / "zoo.ttl"), str(tmp_path / "zoo"))
    assert told.code == 2 and "pip install 'casper-hri[owl]'" in told.err


def test_a_misspelt_value_is_a_finding_and_nothing_else_is_printed(tmp_path):
    import subprocess
    import sys

    (tmp_path / "zoo.ttl").write_text(TURTLE + ':rex :age "abc"^^<http://www.w3.org/2001/XMLSchema#integer> .')
    command = [sys.executable, "-m", "casper", "import", str(tmp_path / "zoo.ttl"), str(tmp_path / "zoo"), "--json"]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.stderr == "" and len(done.stdout.splitlines()) == 1
    assert "is no integer" in done.stdout


def test_a_recording_of_ros_becomes_world_states_that_are_watched(casper, tmp_path):
    pytest.importorskip("mcap_ros2")
    from mcaps import Bag, transform

    bag = Bag(tmp_path / "monday.mcap")
    for step in range(30):
        bag.tf(100 + step / 10, transform(100 + step / 10, "map", "person", (step / 20, 0, 0)), transform(100 + step / 10, "map", "cup", (1, 1, 1)))
    bag.text(103, "hello")
    bag.close()
    (tmp_path / "names.pl").write_text("agent(human, person).\nobject(glass, cup).\n")
    told = casper("import", str(tmp_path / "monday.mcap"), "--names", str(tmp_path / "names.pl"), "--period", "0.5", str(tmp_path / "out"), "--json")
    assert (told.code, [x["severity"] for x in told.json]) == (0, ["note", "note"])
    seen = casper("watch", "kitchen", str(tmp_path / "out" / "monday.jsonl"), "--json").json
    assert [e["t"] for e in seen if e["type"] == "focus"] == [0, 0.5, 1.0, 1.5, 2.0, 2.5]
    assert seen[0]["scores"].keys() == {"glass"}


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("a.mcap", "b.ttl", "out"), "b.ttl is no MCAP file"),
        (("b.ttl", "--period", "1", "out"), "--names and --period are about .mcap files"),
        (("a.mcap", "--period", "0", "out"), "the period is a number of seconds"),
        (("a.mcap", "--names", "n.pl", "--partner", "ann", "out"), "who acts in a recording is said by --names"),
    ],
)
def test_options_that_do_not_fit_a_recording_are_refused(casper, tmp_path, monkeypatch, arguments, told):
    monkeypatch.chdir(tmp_path)
    refused = casper("import", *arguments)
    assert (refused.code, told in refused.err) == (2, True)
