"""The benchmarks of the logic at tiny sizes: they run, and every engine finds the same answers. No time is judged."""

import gc
import importlib.util
import platform
import sys
from dataclasses import replace
from functools import cache
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parent.parent
if str(ROOT) not in sys.path:
    sys.path.append(str(ROOT))

from benchmarks.logic import meaning, report  # noqa: E402
from benchmarks.logic import page as pages  # noqa: E402
from benchmarks.logic.asking import demand, queries, rows  # noqa: E402
from benchmarks.logic.bounds import Bound, against  # noqa: E402
from benchmarks.logic.deriving import closures, games, ontology, shortest  # noqa: E402
from benchmarks.logic.figures import TINY, Figure, Skipped, attempt, clock, fingerprint, per_call  # noqa: E402
from benchmarks.logic.meaning import Held  # noqa: E402
from benchmarks.logic.peers import called, engines, fresh, prolog  # noqa: E402

MEASURED = [family for family in report.FAMILIES if report.name_of(family) not in report.ALONE]
needs_swipl = pytest.mark.skipif(not prolog.is_installed(), reason="SWI-Prolog (swipl) is not installed")


@pytest.fixture(scope="module", autouse=True)
def small_heap():
    """The collections between figures need not walk what the test runner has loaded."""
    gc.collect()
    gc.freeze()
    yield
    gc.unfreeze()


@cache
def tiny(family):
    return report.section(family, TINY)


@pytest.mark.xdist_group("logic benchmarks")
@pytest.mark.parametrize("family", MEASURED, ids=report.name_of)
def test_every_engine_finds_the_same_answers(family):
    found = tiny(family)
    assert found.figures and not found.differing and not found.broken
    assert [x for x in found.found if isinstance(x, Skipped) and x.engine.startswith("casper")] == []
    assert all(x.amount >= 0 or x.engine == "swipl" for x in found.figures)  # an empty loop may be slower than a tiny one


@needs_swipl
@pytest.mark.xdist_group("logic benchmarks")
@pytest.mark.skipif(importlib.util.find_spec("clingo") is None, reason="clingo is not installed")
@pytest.mark.parametrize("family", MEASURED, ids=report.name_of)
def test_every_promise_can_be_judged(family):
    found = tiny(family)
    assert [promise.promise for promise in found.promises if promise.held is None] == []


def test_a_differing_answer_is_told():
    figures = [Figure("t", "casper", 1.0, 3), Figure("t", "clingo", 1.0, 4), Figure("u", "clingo", 1.0, 4)]
    assert dict(report.disagreements(figures)) == {"t": "t: casper found 3, clingo 4"}


def test_where_answers_differ_there_is_no_ratio_and_no_promise():
    class Family:
        __name__, TITLE, TIMED = "x.family", "T", "timed"

        @staticmethod
        def measure(sizes):
            yield from (Figure("t", "casper", 1.0, 3), Figure("t", "clingo", 2.0, 4))

        @staticmethod
        def promises(amounts, sizes):
            yield Bound("faster", amounts.get(("t", "casper")), 1, "s")

    found = report.section(Family(), TINY)
    text = pages.part(found)
    assert "| t | 1 s | 2 s |" in text and "**Answers differ:**\n\n- t: casper found 3, clingo 4" in text
    assert found.promises[0].held is None and "**not judged**" in text


def test_a_family_that_fails_is_a_line_and_does_not_end_the_run(capsys):
    class Family:
        __name__, TITLE, TIMED = "x.family", "T", "timed"

        @staticmethod
        def measure(sizes):
            yield Figure("t", "casper", 1.0)
            raise ValueError("no such thing")

        @staticmethod
        def promises(amounts, sizes):
            yield from ()

    found = report.section(Family(), TINY)
    assert found.broken and "T: casper left out: it failed: ValueError: no such thing" in pages.part(found)


def test_the_fingerprint_tells_rows_apart_but_not_their_order():
    assert (
        fingerprint([("a", 1), ("b", 2)])
        == fingerprint([("b", 2), ("a", 1)])
        != fingerprint([("a", 2), ("b", 1)])
    )


def test_the_closures_hold_the_pairs_that_are_known_beforehand():
    outcomes = {
        task: engines.casper([closures.program(edges, "left")], TINY)
        for task, edges in closures.graphs(TINY).items()
    }
    counts = [outcome.answers[0] for outcome in outcomes.values()]
    assert counts[1:] == [TINY.chain * (TINY.chain + 1) // 2, TINY.cycle**2]


def test_the_least_distances_are_dijkstras():
    edges = shortest.graph(TINY)
    _, answers = shortest.ours(edges, shortest.NAMED, "dist(Y, D)")
    assert answers == fingerprint(shortest.distances(edges).items())


def test_a_game_with_circles_has_drawn_positions():
    kb = engines.stated({"move": [("a", "b"), ("b", "a"), ("b", "c"), ("d", "d")]}, games.RULE)
    assert sorted(games.positions(kb)) == [("b", "true"), ("d", "undefined")]


def test_the_ontology_has_as_many_facts_and_axioms_as_it_says():
    made = ontology.generated()
    assert len(made.types) + len(made.links) == 85_000 and sum(map(len, made.axioms.values())) == 1_110
    assert made == ontology.generated()


def test_both_encodings_of_the_ontology_derive_as_much():
    made = ontology.generated(TINY.ontology)
    one, other = (
        engines.casper([p], TINY).answers[0] for p in (ontology.as_facts(made), ontology.as_rules(made))
    )
    assert one == other > len(made.types) + len(made.links)


def test_deriving_a_base_that_answers_on_demand_lists_all_of_it():
    program = ontology.as_facts(ontology.generated(0.1))
    kb = engines.loaded(program)
    kb.compile()
    assert kb.stored(("type", 2)) is None
    count = engines.compiled(kb, program)
    assert count == engines.answers_of(kb, program)[0] > sum(map(len, program.facts.values()))


def test_an_absent_peer_is_a_visible_line(monkeypatch):
    monkeypatch.setattr(prolog, "is_installed", lambda: False)
    monkeypatch.setattr(engines.importlib.util, "find_spec", lambda name: None)
    found = report.section(closures, TINY)
    text = pages.part(found)
    assert {x.engine for x in found.figures} == {"casper", "casper, right recursion"}
    assert "clingo left out: the Python package clingo is not installed" in text
    assert "swipl left out: swipl is not on the PATH" in text
    assert [x.reason for x in called.calls("f(a).", {"t": "f(X)"}, TINY)] == ["swipl is not on the PATH"] * 3


def test_a_peer_that_fails_gives_its_reason():
    def failing():
        raise RuntimeError("swipl: Warning: something\nmore")

    assert attempt("t", "swipl", failing) == Skipped("t", "swipl", "it failed: RuntimeError: swipl: Warning: something")
    assert attempt("t", "swipl", lambda: "too slow") == Skipped("t", "swipl", "too slow")


def test_a_process_that_takes_too_long_is_stopped():
    import time

    began = time.monotonic()
    with pytest.raises(TimeoutError, match="did not finish in 1 s"):
        fresh.fresh(time.sleep, 60, limit=1)
    assert time.monotonic() - began < 50


def test_a_search_without_end_in_little_memory_says_so():
    said = demand.without_end(TINY.steps)
    assert said.count(";") == 2


@needs_swipl
def test_the_rows_of_a_goal_and_a_first_answer_come_out_of_swi_prolog():
    text = "f(a). f(b). g(X, Y) :- f(X), f(Y)."
    assert prolog.enumerated(text, "g(X, Y)", ["X", "Y"], TINY)[1] == fingerprint(
        (x, y) for x in "ab" for y in "ab"
    )
    assert prolog.first(text, "g(b, X)", "X", TINY)[1] == "a"
    assert prolog.consulted(text, "g(b, a)", TINY)[1] is True
    assert prolog.consulted(text, "g(b, c)", TINY)[1] is False


def test_the_tests_that_hold_promises_are_there():
    for name in (name for tests in meaning.HELD.values() for name in tests.names):
        file, _, test = name.partition("::")
        path = ROOT / "tests" / "kb" / file
        assert path.exists() and (not test or f"def {test}(" in path.read_text())


def test_passed_failed_and_skipped_tests_are_counted(tmp_path):
    file = tmp_path / "test_three.py"
    file.write_text("import pytest\ndef test_a(): pass\ndef test_b(): assert False\ndef test_c(): pytest.skip('x')\n")
    assert meaning.run(Held((str(file),)), thorough=False) == (1, 2)
    file.write_text("this is no Python")
    assert meaning.run(Held((str(file),)), thorough=False) == (0, 1)


def test_plain_kanren_is_not_asked_for_more_rows_once_it_grew_too_slow():
    found = report.section(rows, replace(TINY, rows=(10, 20, 40), patience=0.0)).found
    asked = {x.task for x in found if isinstance(x, Figure) and x.engine == "kanren"}
    assert asked and not any("40 rows" in task for task in asked)


def part(name, title, promise):
    return report.Section(name, title, "timed", (Figure(title, "casper", 1.0),), {}, (promise,))


def test_the_page_keeps_what_others_wrote_and_the_parts_that_were_not_measured(tmp_path):
    page = tmp_path / "benchmarks.md"
    page.write_text("# Benchmarks\n\nThe mind.\n")
    kept, lost = Bound("quick", 1.0, 2.0, "s"), Bound("quicker", 3.0, 2.0, "s")
    pages.keep([part("rows", "First rows", kept), part("games", "Games", lost)], ["rows", "games"], page)
    page.write_text(page.read_text() + "The end.\n")
    pages.keep([part("rows", "Rows anew", kept)], ["rows", "games"], page)
    text = page.read_text()
    assert "First rows" not in text
    order = [text.index(x) for x in ("The mind.", "2 promises 1 are kept, 1 are not", "Rows anew", "### Games", "The end.")]
    assert order == sorted(order)


def test_promises_are_judged_on_their_side():
    assert Bound("p", 3.0, 2.0, "×").held is False and Bound("p", 3.0, 2.0, "×", at_least=True).held is True
    assert Bound("p", None, 2.0, "×").held is None


def test_what_came_to_no_end_while_its_peer_did_is_not_kept():
    assert against({("t", "clingo"): 1.0}, "t", "clingo").held is False
    assert against({}, "t", "clingo").held is None


def test_amounts_have_the_unit_that_suits_them():
    shown = [pages.amount(*x) for x in ((0.5, "s"), (2e-6, "s"), (3 * 2**20, "bytes"), (12.0, "bytes"), (7, ""))]
    assert shown == ["500 ms", "2 µs", "3 MiB", "12 bytes", "7"]


def test_the_machine_is_described_without_its_name_or_paths():
    described = pages.machine()
    assert "Python" in described and "/" not in described and platform.node() not in described


def test_eat_has_eight_modes():
    assert len(queries.modes()) == 8


def test_a_timed_call_gives_its_result_too():
    seconds, result = per_call(sum, (1, 2), sizes=TINY)
    assert seconds > 0 and result == 3


def test_the_command_runs_one_family_by_either_clock_and_refuses_others(capsys, monkeypatch):
    monkeypatch.setenv("LOGIC_BENCHMARK_CLOCK", "wall")
    assert report.main(["--tiny", "reasons"]) in (0, 1)
    shown = capsys.readouterr().out
    assert "| kitchen: why, a provable statement |" in shown and "wall clock" in shown
    assert report.main(["--tiny", "--cpu", "reasons"]) in (0, 1)
    assert clock() == "cpu" and "processor time" in capsys.readouterr().out
    with pytest.raises(SystemExit):
        report.main(["--tiny", "nothing"])
