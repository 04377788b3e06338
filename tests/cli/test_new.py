"""``casper new``: what it writes works, and nothing that is there is written over."""

import pytest

from casper.engine.domain.domain import shipped_domains


def test_a_minimal_domain_is_written_and_the_next_three_commands_are_told(casper, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = casper("new", "tea")
    assert (told.code, told.err) == (0, "")
    assert sorted(file.name for file in (tmp_path / "tea").iterdir()) == ["ontology.pl", "plans.pl", "tests.pl"]
    assert told.out.splitlines()[1:] == [
        "next:",
        "    casper check tea",
        "    casper explain tea 'pick_and_place(cup, tray)'",
        '    casper query tea "valid(S)"',
    ]


@pytest.mark.parametrize("like", shipped_domains())
def test_whatever_it_is_like_and_with_a_room_the_checks_find_no_fault(like, casper, tmp_path):
    assert casper("new", str(tmp_path / "mine"), "--like", like, "--with-scene").code == 0
    assert {found["severity"] for found in casper("check", str(tmp_path / "mine"), "--json").json} <= {"note"}


def test_with_a_room_the_next_step_is_to_run_it(casper, tmp_path):
    (told,) = casper("new", str(tmp_path / "my tea"), "--with-scene", "--json").json
    assert told["next"][-1] == f"casper run '{tmp_path}/my tea' --seed 1"
    assert set(told["files"]) == {"ontology.pl", "plans.pl", "actions.pl", "scene.pl", "tests.pl"}


def test_a_folder_with_something_in_it_is_refused_and_stays_as_it_is(casper, tmp_path):
    (tmp_path / "plans.pl").write_text("mine --> wave.")
    told = casper("new", str(tmp_path))
    assert told.code == 2 and "is not empty, and nothing is written over" in told.err
    assert [(file.name, file.read_text()) for file in tmp_path.iterdir()] == [("plans.pl", "mine --> wave.")]


def test_a_file_is_no_folder(casper, tmp_path):
    (tmp_path / "tea").write_text("mine")
    told = casper("new", str(tmp_path / "tea"))
    assert told.code == 2 and "is a file" in told.err
    assert (tmp_path / "tea").read_text() == "mine"


def test_a_folder_that_cannot_be_is_one_sentence(casper):
    told = casper("new", "/proc/tea")
    assert told.code == 2 and told.err.startswith("casper: nothing can be written to") and told.err.count("\n") == 1


def test_a_template_nobody_knows_names_those_there_are(casper, tmp_path):
    told = casper("new", str(tmp_path / "mine"), "--like", "kitchn")
    assert (
        told.code == 2 and "did you mean kitchen?" in told.err and "care_home, kitchen, minimal, workshop" in told.err
    )
    assert not (tmp_path / "mine").exists()
