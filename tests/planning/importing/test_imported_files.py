"""PDDL and HDDL as folders: what is in them, where a mistake is, and what is told of what is left out."""

from pathlib import Path

import pytest

pytest.importorskip("unified_planning", reason="planning needs: pip install 'casper-hri[planning]'")

from unified_planning.environment import get_environment

from casper import Domain
from casper.kb.errors import CasperError, ReadError
from casper.planning import Who, import_files

DOMAIN = """(define (domain delivery)
  (:requirements :typing :hierarchy :negative-preconditions :equality)
  (:types place thing - object  truck package - thing)
  (:predicates (at ?x - thing ?p - place) (road ?a - place ?b - place))
  (:task go :parameters (?t - truck ?to - place))
  (:method m-there :parameters (?t - truck ?to - place) :task (go ?t ?to)
    :precondition (at ?t ?to) :ordered-subtasks ())
  (:method m-via
    :parameters (?t - truck ?from - place ?to - place) :task (go ?t ?to)
    :subtasks (and (a (go ?t ?from)) (b (drive ?t ?from ?to)))
    :ordering (and (< a b))
    :constraints (not (= ?from ?to)))
  (:action drive :parameters (?t - truck ?from - place ?to - place)
    :precondition (and (at ?t ?from) (road ?from ?to))
    :effect (and (not (at ?t ?from)) (at ?t ?to))))
"""
PROBLEM = """(define (problem two-roads) (:domain delivery)
  (:objects home shop port - place  lorry van - truck)
  (:htn :ordered-subtasks (and (go lorry port)))
  (:init (at lorry home) (at van shop) (road home shop) (road shop port)))
"""


def written(folder, domain=DOMAIN, problem=PROBLEM):
    files = [folder / "domain.hddl", folder / "problem.hddl"]
    for file, text in zip(files, (domain, problem)):
        file.write_text(text)
    return files


@pytest.fixture
def delivery(tmp_path):
    import_files(written(tmp_path)).write(tmp_path / "delivery")
    return Domain.load(tmp_path / "delivery")


def test_methods_are_productions_and_recursion_stays_as_it_is(delivery):
    assert [str(p) for p in delivery.library.productions] == [
        "task_network --> {method(task_network)}, go(lorry, port).",
        "go(T, To) --> {method('m-there'(T, To))}.",
        "go(T, To) --> {method('m-via'(T, From, To))}, {From \\= To}, go(T, From), drive(T, From, To).",
    ]
    assert not delivery.library.is_listed


def test_an_action_is_valid_in_the_state_after_what_happened(delivery):
    went = [("drive(human, lorry, home, shop)", 1.0)]
    assert delivery.kb.verify("drive(robot, lorry, home, shop)").valid
    assert not delivery.kb.verify("drive(robot, lorry, home, shop)", went).valid
    assert delivery.kb.verify("drive(robot, lorry, shop, port)", went).valid


def test_a_refusal_names_what_does_not_hold(delivery):
    assert delivery.kb.verify("drive(human, lorry, shop, port)").reasons == ("holds(at(lorry, shop), now) does not hold",)


def test_the_agent_may_be_a_parameter(tmp_path):
    imported = import_files(written(tmp_path), Who("truck", robot="van"))
    domain = imported.domain()
    assert (domain.partner, domain.robot) == ("lorry", "van")
    assert domain.kb.verify("drive(lorry, home, shop)").valid
    assert str(domain.library.productions[2]).endswith("go(T, From), by(T, drive(From, To)).")


def test_what_the_framework_reads_is_left_as_it_was(tmp_path):
    before = get_environment().error_used_name
    import_files(written(tmp_path))
    assert get_environment().error_used_name is before


@pytest.mark.parametrize(
    ("old", "new", "line", "told"),
    [
        ("(< a b))", "(< a b) (< b a))", 8, "the method m-via is left out: its order runs in a circle (a < b < a); take out"),
        ("(:action drive", "(:durative-action drive", 13, "cannot read"),
        ("(at ?t ?from)) (at ?t ?to))", "(at ?t ?from)) (at ?t ?tou))", 15, "tou"),
        ("(road ?a - place ?b - place)", "(road ?a - plaice ?b - place)", 4, "Undefined parameter's type: plaice (it requires"),
        ("(at ?t ?from)) (at ?t ?to))", "(at ?t ?from)) (at ?to ?t))", 15, "cannot read this: The expression 'at(to, t)' is not well"),
        ("(not (= ?from ?to)))", "(not (= ?from ?too)))", 12, "the method m-via has no ?too"),
        ("(not (= ?from ?to)))", "(road ?from ?to))", 12, "(road ?from ?to) is no constraint: write =, not, and, or"),
    ],
)  # fmt: skip
def test_a_mistake_or_what_is_left_out_is_told_with_its_place(tmp_path, old, new, line, told):
    assert old in DOMAIN
    files = written(tmp_path, DOMAIN.replace(old, new))
    try:
        (said,) = [str(f) for f in import_files(files).findings if f.place.line == line]
    except ReadError as mistake:
        said = str(mistake)
    assert told in said
    assert said.startswith(str(files[0]))


def test_a_bracket_that_is_never_closed_is_told_where_it_opens(tmp_path):
    files = written(tmp_path, problem=PROBLEM[: PROBLEM.rindex("(road")])
    with pytest.raises(ReadError, match=r"problem.hddl:\d+:\d+: this bracket is never closed"):
        import_files(files)


def test_good_parts_are_kept(tmp_path):
    """A method with a circle is left out; actions and the other method stay."""
    files = written(tmp_path, DOMAIN.replace("(< a b))", "(< a b) (< b a))"))
    imported = import_files(files)
    assert "m-there" in imported.files["plans.pl"]
    assert "m-via" not in imported.files["plans.pl"]
    assert "drive(Agent, T, From, To) :- " in imported.files["ontology.pl"]
    assert "% left out: the method m-via" in imported.files["ontology.pl"]


def test_an_object_of_the_wrong_type_is_told(tmp_path):
    files = written(tmp_path, problem=PROBLEM.replace("(at van shop)", "(at shop van)"))
    with pytest.raises(ReadError, match=r"problem\.hddl"):
        import_files(files)


def test_two_problems_are_refused(tmp_path):
    domain, problem = written(tmp_path)
    with pytest.raises(CasperError, match="these are 1 domains and 2 problems"):
        import_files([domain, problem, problem])


def test_a_type_of_agents_that_is_none_is_told(tmp_path):
    with pytest.raises(CasperError, match="the problem has no type boat of agents; its types are"):
        import_files(written(tmp_path), Who("boat"))


def test_a_method_with_an_action_that_is_left_out_is_left_out(tmp_path):
    slow = """  (:durative-action drive :parameters (?t - truck ?from - place ?to - place) :duration (= ?duration 1)
    :condition (and (at start (at ?t ?from))) :effect (and (at end (at ?t ?to)))))
"""
    files = written(tmp_path, DOMAIN[: DOMAIN.index("  (:action drive")] + slow)
    told = [str(finding) for finding in import_files(files).findings]
    assert told[0].startswith(f"{files[0]}:8: warning: the method m-via is left out: it needs the action drive")
    assert told[1].startswith(f"{files[0]}:13: warning: the action drive is left out: it takes time")


def test_an_order_with_delays_is_left_out(examples):
    from casper.planning import import_problem

    findings = [str(finding) for finding in import_problem(examples["htn-go-temporal"].problem).findings]
    assert any("is left out: its order is more than what comes before what" in told for told in findings)


def test_the_command_writes_a_folder_that_loads(tmp_path, capsys):
    from typer.testing import CliRunner

    from casper.cli import app

    files = [str(file) for file in written(tmp_path)]
    done = CliRunner().invoke(app, ["import", *files, str(tmp_path / "made"), "--agent", "truck"])
    assert done.exit_code == 0, done.output
    assert Domain.load(tmp_path / "made").kb.verify("drive(van, shop, port)").valid
    assert Path(tmp_path / "made" / "plans.pl").read_text().startswith("compound_task(go(truck, place)).")


def test_a_reading_follows_an_imported_hierarchy_in_its_states(tmp_path):
    """Going twice in a row: the second drive is the only one that is left, and the first cannot be done again."""
    once = DOMAIN.replace("(a (go ?t ?from)) ", "").replace(":ordering (and (< a b))", "")
    twice = PROBLEM.replace("(and (go lorry port))", "(and (go lorry shop) (go lorry port))")
    domain = import_files(written(tmp_path, once, twice), Who("truck")).domain()
    reading = domain.reading()
    reading.observe("drive(home, shop)")
    assert reading.posterior == {"task_network": 1.0}
    reading.observe("drive(home, shop)")
    assert reading.count == 0
    reading.undo()
    reading.observe("drive(shop, port)")
    assert reading.count and reading.frontier == ()


def test_no_row_is_listed_for_the_ways_to_fill_parameters(delivery):
    """Otherwise a method of ten parameters of ten objects each would be ten thousand million rows."""
    assert delivery.kb.stored(("method", 1)) is None
    assert delivery.kb.stored(("drive", 4)) is None
    assert delivery.kb.stored(("road", 2)) is not None
