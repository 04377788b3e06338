"""Many rows at once: each has its result, the same wherever it is worked on, and a killed run goes on."""

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

from casper.batch import explain_many, verify_many, watch_many
from casper.batch.journal import Journal
from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError

ROWS = [
    ["pick_and_place(meal, hobs)"],
    {"actions": "pick_and_place; eat", "id": "second"},
    ["wahs"],
    {"action": "eat"},
    {"actions": 5},
    [],
    ["pick_and_place", "sip", "wash"],
] * 3


@pytest.fixture(scope="module")
def alone() -> list[dict]:
    return explain_many("kitchen", ROWS)


def test_each_row_has_what_a_reading_says(alone: list[dict]) -> None:
    reading = Domain.load("kitchen").reading()
    for action in ("pick_and_place", "eat"):
        reading.observe(action)
    told = alone[1]
    assert (told["row"], told["id"], told["mistake"]) == (2, "second", None)
    assert told["posterior"] == dict(reading.posterior) and told["outcome"] == reading.outcome
    assert told["explanations"] == reading.count and told["actions"] == ["pick_and_place", "eat"]


def test_a_row_that_cannot_be_worked_on_is_kept_with_its_mistake(alone: list[dict]) -> None:
    mistakes = [row["mistake"] for row in alone[:7]]
    assert mistakes[0] is mistakes[1] is mistakes[5] is mistakes[6] is None
    assert "did you mean wash?" in mistakes[2]
    assert "no actions; it has action" in mistakes[3] and "not 5" in mistakes[4]
    assert [row["row"] for row in alone] == list(range(1, len(ROWS) + 1))


def test_all_rows_have_the_same_columns_but_for_what_they_bring(alone: list[dict]) -> None:
    assert len({frozenset(row) - {"id", "action"} for row in alone}) == 1


def test_two_processes_give_the_same_table(alone: list[dict]) -> None:
    assert explain_many("kitchen", ROWS, jobs=2) == alone


def test_a_dask_cluster_of_two_workers_gives_the_same_table(alone: list[dict]) -> None:
    distributed = pytest.importorskip("distributed", reason="the cluster needs Dask: pip install 'casper-hri[batch]'")
    with distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster:
        assert explain_many("kitchen", ROWS, cluster=cluster.scheduler_address) == alone
        statements = ["eat(human, meal, plate)", "eat(tiago, meal, plate)", "eat("]
        found = verify_many("kitchen", statements, cluster=cluster.scheduler_address)
    assert [row["valid"] for row in found] == [True, False, None] and found == verify_many("kitchen", statements)


def test_verdicts_have_their_reasons() -> None:
    (told,) = verify_many("kitchen", ["eat(tiago, meal, plate)"])
    assert told == {
        "row": 1, "statement": "eat(tiago, meal, plate)", "valid": False, "completed": None,
        "reasons": ["tiago is not a human"], "mistake": None,
    }  # fmt: skip


def test_a_domain_that_was_changed_in_python_is_the_one_that_is_asked() -> None:
    domain = Domain.load("kitchen")
    domain.kb.assert_("human(eve)")
    assert verify_many(domain, ["eat(eve, meal, plate)"])[0]["valid"] is True


def test_a_recording_is_watched_to_its_end(tmp_path: Path) -> None:
    world = '{"t": %s, "agents": {"human": {"x": 0, "y": 0, "heading": 0, "holding": null}}, "objects": {}}\n'
    recording = tmp_path / "day.jsonl"
    recording.write_text(world % 0 + "nonsense\n" + world % 1, encoding="utf-8")
    told, lost = watch_many("kitchen", [str(recording), str(tmp_path / "none")], policy="best")
    assert told["left_out"] == 1 and told["observed"] == 0 and told["predicted"] is None
    assert "cannot read" in lost["mistake"]


@pytest.mark.parametrize(
    "options, word",
    [
        ({"policy": "brave"}, "strict or best"),
        ({"jobs": 0}, "whole number from 1"),
        ({"jobs": True}, "whole number from 1"),
        ({"out": "there/is/no/folder.csv"}, "no folder"),
        ({"out": "table.xls"}, ".csv, .jsonl, .parquet"),
        ({"cluster": "nowhere"}, "cannot be reached"),
    ],
)
def test_what_cannot_be_used_is_told_once(options: dict, word: str) -> None:
    with pytest.raises(CasperError, match=word):
        explain_many("kitchen", ROWS, **options)


# --- a run that ends too soon ---------------------------------------------------------------------------------------


def test_a_killed_run_goes_on_where_it_was_without_losing_or_repeating_a_row(tmp_path: Path) -> None:
    table, out, journal = tmp_path / "rows.jsonl", tmp_path / "out.jsonl", tmp_path / "out.jsonl.journal"
    rows = [{"actions": ["pick_and_place", "eat"] * (1 + n % 2), "id": n} for n in range(3000)]
    table.write_text("".join(json.dumps(row) + "\n" for row in rows), encoding="utf-8")
    command = [sys.executable, "-m", "casper", "batch", "explain", "kitchen", str(table), str(out), "--quiet"]
    first = subprocess.Popen(command)
    while not (journal.exists() and journal.stat().st_size > 20_000):
        time.sleep(0.005)
        assert first.poll() is None, "it was over before it could be killed"
    os.kill(first.pid, signal.SIGKILL)
    first.wait()
    kept = journal.read_bytes().count(b"\n") - 1
    assert 0 < kept < len(rows) and not out.exists()
    with journal.open("ab") as torn:
        torn.write(b'{"row": 2999, "outc')
    assert subprocess.run(command).returncode == 0 and not journal.exists()
    found = [json.loads(line) for line in out.read_text(encoding="utf-8").splitlines()]
    assert found == explain_many("kitchen", rows)


def test_the_journal_of_another_run_is_not_taken(tmp_path: Path) -> None:
    file = tmp_path / "out.csv.journal"
    Journal(file, {"task": "explain"}).close(finished=False)
    with pytest.raises(CasperError, match="journal of another run"):
        explain_many("kitchen", ROWS, out=tmp_path / "out.csv")
    assert file.exists()


def test_rows_in_a_journal_are_not_worked_on_again(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    import casper.batch.many as many

    worked: list[int] = []
    real = many.work_on

    def some(job, rows):
        if len(worked) >= 8:
            raise KeyboardInterrupt
        worked.extend(row.number for row in rows)
        return real(job, rows)

    monkeypatch.setattr(many, "work_on", some)
    with pytest.raises(KeyboardInterrupt):
        explain_many("kitchen", ROWS, out=tmp_path / "out.csv")
    before, worked[:] = list(worked), []
    monkeypatch.setattr(many, "work_on", lambda job, rows: (worked.extend(r.number for r in rows), real(job, rows))[1])
    explain_many("kitchen", ROWS, out=tmp_path / "out.csv")
    assert before and sorted(before + worked) == list(range(1, len(ROWS) + 1))


def test_the_command_tells_of_rows_with_mistakes_and_exits_with_1(tmp_path: Path) -> None:
    (tmp_path / "rows.csv").write_text("statement\n\"eat(human, meal, plate)\"\neat(\n", encoding="utf-8")
    command = [sys.executable, "-m", "casper", "batch", "verify", "kitchen", str(tmp_path / "rows.csv"), str(tmp_path / "out.csv")]
    done = subprocess.run(command, capture_output=True, text=True)
    assert done.returncode == 1 and "2 rows, 1 with a mistake" in done.stdout and "row 2: <query>:1:5: the text ends here" in done.stdout
    wrong = subprocess.run([*command, "--noise", "0.1"], capture_output=True, text=True)
    assert wrong.returncode == 2 and "not about verify" in wrong.stderr
