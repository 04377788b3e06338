"""A whole domain is checked: how its clauses, its plans and its settings fit together."""

import pytest

from casper.engine.domain.check import check_domain
from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError, DomainError

ONTOLOGY = """\
human(ann). robot(rob). agent(X) :- human(X). agent(X) :- robot(X).
cup(mug). sink(sink).
fill(A, T) :- agent(A), cup(T).
drink(A, T) :- human(A), cup(T).
wash(A, T, D) :- agent(A), cup(T), sink(D).
"""
PLANS = """\
goal(tea(C)) :- cup(C).
tea(C) --> fill(C), drink(C), clean(C).
clean(C) --> wash(C, sink).
"""


def found(folder, **files):
    for name, text in {"ontology": ONTOLOGY, "plans": PLANS, **files}.items():
        if text is not None:
            (folder / f"{name}.pl").write_text(text)
    return [(f.place.file.rsplit("/", 1)[-1], f.place.line, str(f.severity), f.message) for f in check_domain(folder)]


def test_a_sound_domain_has_no_findings(tmp_path):
    assert found(tmp_path) == []


def test_the_kitchen_has_neither_errors_nor_warnings():
    assert [f for f in check_domain("kitchen") if f.severity != "note"] == []


def test_no_such_domain_is_an_error_of_its_own(tmp_path):
    with pytest.raises(DomainError, match="there is no domain"):
        check_domain(tmp_path / "nowhere")


@pytest.mark.parametrize(
    ("files", "finding"),
    [
        ({"plans": "goal(tea(C)) :- cup(C).\ntea(C) --> fil(C).\n"}, ("plans.pl", 2, "error", "fil/1 is no task, and no rule fil/2 says when it is valid as an action")),
        ({"plans": PLANS + "goal(coffee(_)).\n"}, ("plans.pl", 4, "error", "the goal coffee(_) has no production: write coffee --> …")),
        ({"plans": PLANS + "prior(coffee, 1.0).\n"}, ("plans.pl", 4, "error", "prior(coffee, 1.0): coffee is no goal")),
        ({"plans": PLANS + "goal(3).\n"}, ("plans.pl", 4, "error", "goal(3) does not name a goal: write goal(name) or goal(name(Parameter))")),
        ({"plans": PLANS + "goal(a).\na --> b.\nb --> a.\n"}, ("plans.pl", 5, "error", "the task a can only go on for ever (a needs b needs a): give it a production that ends, such as a --> []")),
        ({"plans": PLANS + "goal(z).\nz --> {cup(X), \\+ cupp(X)}, fill(X).\n"}, ("plans.pl", 5, "error", "nothing defines cupp/1; did you mean cup?")),
        ({"plans": PLANS + "goal(z).\nz --> by(bob, fill(mug)), drink(mug).\n"}, ("plans.pl", 5, "error", "bob of by(bob, fill(mug)) is no agent of this world; did you mean rob?")),
        ({"plans": PLANS + "rinse(C) --> wash(C, sink).\n"}, ("plans.pl", 4, "warning", "no goal leads to the task rinse/1; use it in a plan, or state goal(rinse(_)).")),
        ({"plans": PLANS + "clean(pot) --> wash(pot, sink).\n"}, ("plans.pl", 1, "warning", "one way to pursue tea is impossible: pot is not a cup")),
        ({"plans": PLANS.replace("clean(C)\n", "clean(mug)\n").replace("clean(C).", "clean(mug).") + "clean(pot) --> wash(pot, sink).\n"}, ("plans.pl", 4, "warning", "this way to do clean(pot) is part of no plan: no use of it fits its parameters")),
        ({"plans": "goal(t).\nt --> wash(mug, mug).\n"}, ("plans.pl", 1, "error", "the goal t cannot be pursued: nobody can do wash(mug, mug), because mug is not a sink")),
        ({"plans": "goal(t).\nt --> wash(mug, sink) ; wash(sink, sink).\n"}, ("plans.pl", 2, "warning", "one way to pursue t is impossible: nobody can do wash(sink, sink), because sink is not a cup")),
        ({"plans": "goal(t(C)) :- cup(C), sink(C).\nt(C) --> fill(C).\n"}, ("plans.pl", 1, "error", "the goal t cannot be pursued: ")),
        ({"plans": "goal(t(C)) :- c is 1 + C.\nt(C) --> fill(C).\n"}, ("plans.pl", 1, "error", "the goal t cannot be pursued: c is 1 + C cannot be decided")),
        ({"ontology": ONTOLOGY.replace("fill(A, T) :- agent(A)", "fill(A, T) :- robot(A)")}, ("plans.pl", 2, "note", "ann is never seen to do fill(mug) of tea, because ann is not a robot; others can do it")),
        ({"ontology": ONTOLOGY + 'never("no tea") :- claim(drink(_, _)).\n'}, ("plans.pl", 1, "error", "the goal tea cannot be pursued: nobody can do drink(mug), because no tea")),
        ({"plans": PLANS + PLANS.splitlines()[2]}, ("plans.pl", 4, "warning", "this says the same as line 3; take one of them out")),
        ({"plans": None, "actions": "setting(focus, treshold, 1).\n"}, ("actions.pl", 1, "error", "setting(focus, treshold, …) is unknown")),
        ({"actions": "setting(focus, threshold, 0.5).\nsetting(focus, threshold, high).\n"}, ("actions.pl", 2, "error", "setting(focus, threshold, high): 'high' should be a number")),
        ({"actions": "setting(focuss, threshold, 1).\n"}, ("actions.pl", 1, "warning", "nothing reads settings of focuss; did you mean focus?")),
        ({"ontology": ONTOLOGY + "polish(T) :- cup(T).\n"}, ("ontology.pl", 6, "note", "nothing needs polish/1")),
        ({"ontology": ONTOLOGY + "p(X) :- coup(X).\n", "plans": PLANS}, ("ontology.pl", 6, "error", "nothing defines coup/1; did you mean cup?")),
        ({"ontology": "% nothing but ï\n", "plans": "t --> .\n"}, ("plans.pl", 1, "error", "'.' does not belong here")),
        ({"ontology": ':- include("gone.pl").\n' + ONTOLOGY}, ("ontology.pl", 1, "error", "there is no file gone.pl to include beside this one")),
    ],
)  # fmt: skip
def test_a_mistake_is_told_with_its_place(tmp_path, files, finding):
    told = found(tmp_path, **files)
    file, line, severity, start = finding
    assert any((f, n, s) == (file, line, severity) and m.startswith(start) for f, n, s, m in told), told


ACTIONS = ONTOLOGY + "".join(f"{name}(A) :- agent(A).\n" for name in "abcd") + "bad(A) :- agent(A), sink(A).\n"


def told_of(tmp_path, plans, more=""):
    return [(s, m) for f, _, s, m in found(tmp_path, ontology=ACTIONS + more, plans=plans) if f == "plans.pl" and s != "note"]


def test_an_optional_part_nobody_can_do_keeps_nobody_from_the_goal(tmp_path):
    (finding,) = told_of(tmp_path, "goal(g). g --> a, optional(bad), c.\n")
    assert finding[0] == "warning"
    assert finding[1].startswith("an optional part of g is impossible: nobody can do bad, because ")


def test_where_the_order_is_open_a_step_is_tried_at_its_best_moment(tmp_path):
    never = 'never("c comes first") :- claim(b(_)), \\+ did(c(_), _).\n'
    assert told_of(tmp_path, "goal(g). g --> a, unordered(b, c).\n", never) == []
    assert told_of(tmp_path, "goal(g). g --> a, b, c.\n", never) == [("error", "the goal g cannot be pursued: nobody can do b, because c comes first")]


def test_the_time_between_two_steps_makes_no_plan_impossible(tmp_path):
    never = 'never("not so soon") :- claim(b(_)), did(a(_), T), \\+ (did(c(_), T2), T2 - T >= 60).\n'
    assert told_of(tmp_path, "goal(g). g --> a, c, b.\n", never) == []
    unseen = 'never("not so soon") :- claim(b(_)), did(a(_), T), \\+ (did(c(_), T2), T2 > T).\n'
    assert [s for s, _ in told_of(tmp_path, "goal(g). g --> a, b, c.\n", unseen)] == ["error"]


def test_many_choices_hide_neither_a_way_nor_another_goal(tmp_path):
    choices = ", ".join(["(b ; c)"] * 12)
    told = told_of(tmp_path, f"goal(g). goal(h). g --> (bad ; a), {choices}. h --> a, bad.\n")
    assert sorted((s, m.split(":")[0]) for s, m in told) == [("error", "the goal h cannot be pursued"), ("warning", "one way to pursue g is impossible")]


def test_all_of_them_are_told_at_once_in_order(tmp_path):
    told = found(tmp_path, ontology=ONTOLOGY + "p(X) :- coup(X).\nq(X :- cup(X).\n", plans=PLANS + "goal(x).\n", actions="context(use).\n setting(focus, a, 1).\n")
    assert [(f, n) for f, n, s, _ in told if s == "error"] == [("actions.pl", 2), ("ontology.pl", 6), ("ontology.pl", 7), ("plans.pl", 4)]
    assert told == sorted(told, key=lambda finding: finding[:2])


def test_a_file_that_is_no_text_is_told_and_the_others_are_checked(tmp_path):
    (tmp_path / "scene.pl").write_bytes(b"\xff\xfe\x00")
    told = found(tmp_path, plans=PLANS + "goal(x).\n")
    assert [(f, n) for f, n, s, _ in told if s == "error"] == [("plans.pl", 4), ("scene.pl", 0)]


def test_without_an_ontology_a_misspelt_task_is_suspected(tmp_path):
    told = found(tmp_path, ontology=None, plans="tea --> boil, claen.\nclean --> rinse.\n")
    assert ("plans.pl", 1, "warning", "claen/0 has no production, so it counts as an action; did you mean clean?") in told


def test_recursion_that_is_allowed_is_no_mistake(tmp_path):
    plans = "goal(t).\nsetting(plans, recursion, 2).\nt --> fill(mug).\nt --> fill(mug), t.\n"
    assert [finding for finding in found(tmp_path, plans=plans) if finding[2] == "error"] == []


def test_a_domain_with_errors_cannot_be_loaded_and_one_without_can(tmp_path):
    assert found(tmp_path) == []
    assert Domain.load(tmp_path).reading() is not None
    found(tmp_path, plans=PLANS + "goal(x).\n")
    with pytest.raises(CasperError):
        Domain.load(tmp_path)


def test_a_price_that_makes_no_sense_is_an_error_with_its_place(tmp_path):
    (tmp_path / "plans.pl").write_text("g --> a, b.\nh --> b, a.\nsetting(plans, begin, 2).\n")
    (finding,) = [f for f in check_domain(tmp_path) if f.severity == "error"]
    assert finding.place.line == 3 and "a price is a number above 0 and below 1" in finding.message


def test_a_condition_that_no_value_satisfies_makes_the_goal_impossible(tmp_path):
    told = told_of(tmp_path, "goal(g). g --> {a(X), \\+ a(X)}, a.\n", "")
    assert any(s == "error" and "the goal g cannot be pursued: {a(X), \\+ a(X)} never holds" in m for s, m in told)
