"""Findings as a person sees them: the line with a caret, and how many there are of each; and as JSON."""

from __future__ import annotations

import pytest

from casper.kb.checks.check import check_text
from casper.kb.checks.finding import note
from casper.kb.checks.printing import excerpt_lines, finding_line, tally
from casper.kb.errors import Place
from casper.kb.text.lines import text_of

TEXT = "human(ann).\nwave(X) :-\thuman(X), robt(X).\nrobot(rob)."


@pytest.fixture
def file(tmp_path):
    path = tmp_path / "t.pl"
    path.write_text(TEXT)
    return str(path)


def excerpt(*place):
    return text_of(excerpt_lines(Place(*place))).splitlines()


def test_the_line_is_shown_with_a_caret_under_the_column(file):
    assert excerpt(file, 2, 22) == ["    wave(X) :- human(X), robt(X).", "    " + " " * 21 + "^"]
    assert excerpt(file, 1, 1) == ["    human(ann).", "    ^"]
    assert excerpt(file, 3) == ["    robot(rob)."]


@pytest.mark.parametrize("line", [0, 4, -1])
def test_a_line_that_is_not_there_is_not_shown(file, line):
    assert excerpt(file, line, 1) == []


def test_a_file_that_cannot_be_read_is_not_shown(tmp_path):
    (tmp_path / "latin.pl").write_bytes(b"caf\xe9.")
    assert excerpt(str(tmp_path / "gone.pl"), 1, 1) == excerpt(str(tmp_path / "latin.pl"), 1, 1) == []


@pytest.mark.parametrize(
    ("severities", "told"),
    [
        ([], "nothing to find fault with"),
        (["error"], "1 error"),
        (["note", "error", "note"], "1 error, 2 notes"),
        (["note", "warning", "warning", "error", "error"], "2 errors, 2 warnings, 1 note"),
    ],
)
def test_findings_are_counted_the_worst_first(severities, told):
    assert tally(severities) == told


def test_a_finding_names_its_file_as_it_is_called_from_here_and_its_line():
    place = Place("far/away/t.pl", 2, 22)
    assert text_of([finding_line(place, "note", "look")]) == "far/away/t.pl:2: note: look"
    assert text_of([finding_line(place, "error", "look", "t.pl")]) == "t.pl:2: error: look"
    assert text_of([finding_line(Place("t.pl"), "warning", "look")]) == "t.pl: warning: look"


def test_a_finding_is_a_line_of_text_and_an_object_in_json():
    (found,) = check_text(TEXT, "t.pl")
    sentence = "nothing defines robt/1; did you mean robot?"
    assert str(found) == f"t.pl:2: error: {sentence}"
    assert found.to_json() == {"file": "t.pl", "line": 2, "column": 22, "severity": "error", "message": sentence}
    assert str(note(Place("t.pl"), "look")) == "t.pl: note: look"


@pytest.mark.parametrize(
    ("text", "finding"),
    [
        (":- table(5). far(a, 1).", (1, "error", "table needs name/arity or path(_, _, min)")),
        (
            'never("two") :- p(X), q(X). p(a). q(X) :- p(X).',
            (1, "error", 'the facts break "two": p(a) (t.pl:1)'),
        ),
        (
            'never("v") :- p(X), Y is X / 0, Y > 1. p(1).',
            (
                *(1, "warning"),
                'whether the facts break "v" is undefined: X = 1, Y = ? is undefined: 1 / 0 has no value: division by zero',
            ),
        ),
        (
            "p(X) :- \\+ q(a), r(X). q(a). r(b).",
            (1, "warning", "\\+ q(a) holds of nothing, so the rule gives nothing"),
        ),
        (
            "p(X) :- r(X), X > 3, s. r(1). s.",
            (1, "warning", "no facts satisfy r(X), X > 3 together, so the rule gives nothing"),
        ),
    ],
)
def test_what_the_facts_say_of_a_rule_or_a_constraint(text, finding):
    assert [(f.place.line, str(f.severity), f.message) for f in check_text(text, "t.pl")] == [finding]


@pytest.mark.parametrize(
    "text",
    [
        'never("deep") :- n(X), X < 0. n(0). n(X) :- n(Y), X is Y + 1.',  # a search without end decides nothing
        "p :- 1 / 0 > 2, q. q.",  # undefined, and no contradiction
        ":- dynamic(q/1). :- dynamic(q/1).",
        "p(X) :- e(X), q(X). e(X) :- e(X). q(a).",  # told where e/1 is defined, if at all
    ],
)
def test_what_cannot_be_decided_is_not_found_fault_with(text):
    assert check_text(text, "t.pl") == []
