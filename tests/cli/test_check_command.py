"""``casper check``: all mistakes at once, for a person and for an editor."""

import json


def domain(folder, **files):
    for name, text in files.items():
        (folder / f"{name}.pl").write_text(text)
    return str(folder)


MISTAKEN = "human(ann).\nwave(A) :- humn(A).\nnod(A, B) :- human(A).\n"
PLANS = "goal(greet).\ngreet --> wave.\n"


def test_the_kitchen_is_clean(casper):
    told = casper("check", "kitchen", "--json")
    assert told.code == 0
    assert [line for line in told.json if line["severity"] in ("error", "warning")] == []


def test_a_finding_is_one_json_object_with_the_keys_of_the_design(casper, tmp_path):
    told = casper("check", domain(tmp_path, ontology=MISTAKEN, plans=PLANS), "--json")
    assert told.code == 1
    first = told.json[0]
    assert first == {
        "file": str(tmp_path / "ontology.pl"),
        "line": 2,
        "column": 12,
        "severity": "error",
        "message": "nothing defines humn/1; did you mean human?",
    }
    assert {"warning", "note"} <= {line["severity"] for line in told.json}


def test_a_file_below_here_is_named_as_seen_from_here(casper, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    told = casper("check", domain(tmp_path, ontology=MISTAKEN), "--json")
    assert {line["file"] for line in told.json} == {"ontology.pl"}


def test_warnings_alone_are_no_failure(casper, tmp_path):
    told = casper("check", domain(tmp_path, ontology="human(ann).\nnod(A, B) :- human(A).\n"), "--json")
    assert [line["severity"] for line in told.json if line["severity"] != "note"] == ["warning"]
    assert told.code == 0


def test_a_person_is_shown_the_line_with_a_caret_and_the_tally(casper, tmp_path):
    told = casper("check", domain(tmp_path, ontology=MISTAKEN, plans=PLANS))
    lines = told.out.splitlines()
    assert lines[0] == f"{tmp_path}/ontology.pl:2: error: nothing defines humn/1; did you mean human?"
    assert lines[1:3] == ["    wave(A) :- humn(A).", "               ^"]
    assert lines[-1] == "1 error, 1 warning, 1 note"


def test_nothing_to_tell_is_said_so(casper, tmp_path):
    folder = domain(tmp_path, ontology="human(ann).\nwave(A) :- human(A).\n", plans="goal(greet).\ngreet --> wave.\n")
    assert casper("check", folder).out.splitlines()[-1] == "nothing to find fault with"


def test_the_kitchen_is_clean_but_for_how_late_a_goal_may_be_certain(casper):
    told = casper("check", "kitchen")
    assert told.code == 0
    assert "breakfast and lunch may both be pursued after 4 observations" in told.out
    assert told.out.splitlines()[-1] == "1 note"


def test_no_such_domain_is_exit_code_2(casper):
    told = casper("check", "kitchn")
    assert told.code == 2
    assert "there is no domain 'kitchn'" in told.err
    assert told.out == ""


def test_brackets_in_a_text_are_shown_as_they_are(casper, tmp_path):
    told = casper("check", domain(tmp_path, ontology="p([bold]).\nq(X) :- r([red], X).\n"))
    assert "r([red], X)" in told.out
    assert json.loads(casper("check", str(tmp_path), "--json").out.splitlines()[-1])["line"] == 2
