"""Plans that are not listed and that nobody could ever finish are errors; what is not known is no error."""

import pytest

from casper.engine.domain.check import check_domain

ONTOLOGY = """\
human(ann). robot(rob). agent(X) :- human(X). agent(X) :- robot(X).
site(home). site(shop). van(v1). boat(nothing) :- fail.
walk(A, S) :- agent(A), site(S).
drive(A, V, S) :- agent(A), van(V), site(S).
fly(A, S) :- agent(A), wings(A), site(S). wings(X) :- boat(X).
deliver(A, S) :- agent(A), site(S).
"""
SOUND = """\
goal(bring(S)) :- site(S).
bring(S) --> get_to(S), deliver(S).
get_to(_) --> [].
get_to(S) --> {site(S)}, walk(S).
get_to(S) --> {van(V)}, get_to(home), drive(V, S).
"""


def told(folder, plans, ontology=ONTOLOGY):
    (folder / "ontology.pl").write_text(ontology)
    (folder / "plans.pl").write_text(plans)
    return [(str(f.severity), f.place.line, f.message) for f in check_domain(folder)]


def errors(folder, plans, ontology=ONTOLOGY):
    return [(line, message) for severity, line, message in told(folder, plans, ontology) if severity == "error"]


def test_of_sound_recursive_plans_it_is_said_that_whole_plans_were_not_tried(tmp_path):
    found = told(tmp_path, SOUND)
    assert {severity for severity, _, _ in found} == {"note"}
    assert any("not of whole plans" in message for _, _, message in found)


@pytest.mark.parametrize(
    ("plans", "line", "said"),
    [
        (SOUND.replace("get_to(S), deliver(S)", "get_to(S), fly(S)"), 1, "nobody can do fly(S), because "),
        (SOUND.replace("get_to(S), deliver(S)", "{boat(B)}, get_to(S), deliver(S)"), 1, "{boat(B)} never holds, because "),
        (SOUND.replace("get_to(S), deliver(S)", "{van(S)}, get_to(S), deliver(S)"), 1, "nothing is goal(bring(S)) and {van(S)} at once"),
        (SOUND.replace("bring(S) --> get_to(S)", "bring(S) --> handed(S)") + "handed(S) --> fly(S).\nhanded(S) --> get_to(S), fly(S).\n", 1, "nobody can do fly(S)"),
        (SOUND.replace("deliver(S).", "done(shop, S).") + "done(home, S) --> deliver(S).\n", 1, "bring needs"),
    ],
    ids=["a step", "a condition", "conditions together", "every way of a task", "no way fits"],
)
def test_a_goal_that_can_never_be_finished_is_an_error_with_its_reason(tmp_path, plans, line, said):
    found = errors(tmp_path, plans)
    assert len(found) == 1
    assert found[0][0] == line
    assert "the goal bring can never be finished: " in found[0][1]
    assert said in found[0][1]


def test_a_way_that_can_never_be_finished_beside_others_is_a_warning(tmp_path):
    found = told(tmp_path, SOUND + "get_to(S) --> get_to(home), fly(S).\n")
    assert [(s, line) for s, line, _ in found if s != "note"] == [("warning", 6)]


def test_what_may_be_done_without_is_no_obstacle(tmp_path):
    assert errors(tmp_path, SOUND.replace("deliver(S).", "optional(fly(S)), (fly(S) ; deliver(S)).")) == []


def test_what_looks_back_at_what_was_done_is_not_known(tmp_path):
    ontology = ONTOLOGY.replace("wings(X) :- boat(X).", "wings(X) :- did(walk(X, _), _).")
    assert errors(tmp_path, SOUND.replace("deliver(S).", "fly(S)."), ontology) == []
