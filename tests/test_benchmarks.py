"""The logic benchmarks at tiny sizes: they run, and every engine finds the same answers. No time is judged."""

import gc
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
if str(ROOT) not in sys.path:
    sys.path.append(str(ROOT))

from benchmarks.logic import closures, ontology, peers, prolog, queries, report, rows  # noqa: E402
from benchmarks.logic.bounds import Bound  # noqa: E402
from benchmarks.logic.figures import TINY, Figure, fingerprint, per_call  # noqa: E402


@pytest.fixture(scope="module", autouse=True)
def small_heap():
    """The collections between figures need not walk what the test runner has loaded."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


@pytest.mark.parametrize("family", report.FAMILIES, ids=report.name_of)
def test_every_engine_finds_the_same_answers(family):
    figures = report.section(family, TINY).figures
    assert figures and list(report.disagreements(figures)) == []
    assert all(
        x.seconds >= 0 or x.engine == "swipl" for x in figures
    )  # the empty loop may be slower than a tiny one


def test_a_differing_answer_is_told():
    figures = [Figure("t", "casper", 1.0, 3), Figure("t", "clingo", 1.0, 4), Figure("u", "clingo", 1.0, 4)]
    assert list(report.disagreements(figures)) == ["t: casper found 3, clingo 4"]


def test_the_fingerprint_tells_rows_apart_but_not_their_order():
    assert (
        fingerprint([("a", 1), ("b", 2)])
        == fingerprint([("b", 2), ("a", 1)])
        != fingerprint([("a", 2), ("b", 1)])
    )


def test_the_closures_hold_the_pairs_that_are_known_beforehand():
    outcomes = {
        task: peers.casper([closures.program(edges, "left")], TINY)
        for task, edges in closures.graphs(TINY).items()
    }
    counts = [outcome.answers[0] for outcome in outcomes.values()]
    assert counts[1:] == [TINY.chain * (TINY.chain + 1) // 2, TINY.cycle**2]


def test_the_ontology_has_as_many_facts_and_axioms_as_it_says():
    made = ontology.generated()
    assert len(made.types) + len(made.links) == 85_000 and sum(map(len, made.axioms.values())) == 1_110
    assert made == ontology.generated()


def test_both_encodings_of_the_ontology_derive_as_much():
    made = ontology.generated(TINY.ontology)
    one, other = (
        peers.casper([p], TINY).answers[0] for p in (ontology.as_facts(made), ontology.as_rules(made))
    )
    assert one == other > len(made.types) + len(made.links)


def test_an_absent_peer_is_a_visible_line(monkeypatch):
    monkeypatch.setattr(prolog, "is_installed", lambda: False)
    monkeypatch.setattr(peers.importlib.util, "find_spec", lambda name: None)
    found = report.section(closures, TINY)
    text = "\n".join(report.page([found], [], None, []))
    assert {x.engine for x in found.figures} == {"casper", "casper, right recursion"}
    assert "clingo left out: the Python package clingo is not installed" in text
    assert "swipl left out: swipl is not on the PATH" in text


def test_plain_kanren_is_not_asked_for_more_rows_once_it_grew_too_slow():
    from dataclasses import replace

    found = report.section(rows, replace(TINY, rows=(10, 20, 40), patience=0.0)).found
    asked = {x.task for x in found if isinstance(x, Figure) and x.engine == "kanren"}
    assert asked and not any("40 rows" in task for task in asked)


def test_the_page_keeps_what_others_wrote(tmp_path):
    page = tmp_path / "benchmarks.md"
    page.write_text("# Benchmarks\n\nThe mind.\n")
    for text in ("first", "second"):
        report.keep(text, page)
        page.write_text(page.read_text() + "The end.\n" * (text == "first"))
    kept = page.read_text()
    assert "first" not in kept and [kept.index(x) for x in ("The mind.", "second", "The end.")] == sorted(
        kept.index(x) for x in ("The mind.", "second", "The end.")
    )


def test_promises_are_judged_on_their_side():
    assert Bound("p", 3.0, 2.0, "×").held is False and Bound("p", 3.0, 2.0, "×", at_least=True).held is True
    assert Bound("p", None, 2.0, "×").held is None


def test_the_machine_is_described_without_its_name_or_paths():
    import platform

    described = report.machine()
    assert "Python" in described and "/" not in described and platform.node() not in described


def test_eat_has_eight_modes():
    assert len(queries.modes()) == 8


def test_a_timed_call_gives_its_result_too():
    seconds, result = per_call(sum, (1, 2), sizes=TINY)
    assert seconds > 0 and result == 3


def test_the_command_runs_one_family_and_refuses_others(capsys):
    assert report.main(["--tiny", "reasons"]) in (0, 1)
    assert "| kitchen: why, a provable statement |" in capsys.readouterr().out
    with pytest.raises(SystemExit):
        report.main(["--tiny", "nothing"])
