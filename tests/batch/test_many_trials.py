"""Many simulated trials: the same rows wherever they are run, none lost, none run twice, none that ends the others."""

import json
import os
from pathlib import Path

import pytest

import casper.batch.trials as running
from casper.batch import judging, run_trials
from casper.engine.domain.altering import altered
from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError
from casper.sim_adapter.room.facts import scene_of

pytest.importorskip("mujoco", reason="trials need MuJoCo: pip install 'casper-hri[sim]'")
TRIALS = [{"seed": 1, "robot": False}, {"goal": "nonsense"}, {"seed": 2, "robot": False, "settings": {"sensor.noise": 0.02}}]


@pytest.fixture(scope="module")
def alone(tmp_path_factory: pytest.TempPathFactory) -> tuple[list[dict], Path]:
    journal = tmp_path_factory.mktemp("trials") / "trials.jsonl"
    return run_trials("minimal", TRIALS, journal=journal), journal


def test_each_row_says_what_became_of_its_trial(alone):
    rows, _ = alone
    assert [row["trial"] for row in rows] == TRIALS
    assert rows[0]["right"] is True and rows[0]["predicted"] == "tea" and rows[0]["helped"] is False
    assert {frozenset(row) for row in rows} == {frozenset(["trial", *judging.FIGURES, "mistake"])}


def test_a_trial_that_cannot_be_run_is_a_row_with_its_reason(alone):
    assert "there is no goal 'nonsense'" in alone[0][1]["mistake"] and alone[0][1]["right"] is None


def test_a_trial_that_breaks_off_is_a_row_with_its_reason(monkeypatch):
    def breaks(domain, settings):
        raise FloatingPointError("Nan, Inf or huge value in QACC\nand more")

    monkeypatch.setattr("casper.sim_adapter.trial.Trial", breaks)
    (row,) = run_trials("minimal", [{"seed": 1}])
    assert row["mistake"] == "the trial broke off: FloatingPointError: Nan, Inf or huge value in QACC"


def test_an_unknown_setting_of_a_trial_is_told():
    (row,) = run_trials("minimal", [{"sead": 1}])
    assert row["mistake"].startswith("a trial has no sead; it has ")


def test_two_processes_give_the_same_rows(alone):
    assert run_trials("minimal", TRIALS, jobs=2) == alone[0]


def test_a_dask_cluster_gives_the_same_rows(alone):
    distributed = pytest.importorskip("distributed", reason="the cluster needs Dask: pip install 'casper-hri[batch]'")
    with distributed.LocalCluster(n_workers=1, threads_per_worker=1, dashboard_address=None) as cluster:
        assert run_trials("minimal", TRIALS[:2], cluster=cluster.scheduler_address) == alone[0][:2]


def test_an_interrupted_run_goes_on_without_losing_or_repeating_a_trial(alone, tmp_path, monkeypatch):
    worked, real = [], running.work_on

    def some(job, rows):
        if len(worked) == 2:
            raise KeyboardInterrupt
        worked.extend(row.given["trial"].get("seed", 0) for row in rows)
        return real(job, rows)

    monkeypatch.setattr(running, "work_on", some)
    journal = tmp_path / "trials.jsonl"
    with pytest.raises(KeyboardInterrupt):
        run_trials("minimal", TRIALS, journal=journal)
    with journal.open("ab") as torn:
        torn.write(b'{"trial": {"se')
    monkeypatch.setattr(running, "work_on", lambda job, rows: (worked.extend([9] * len(rows)), real(job, rows))[1])
    assert run_trials("minimal", TRIALS, journal=journal) == alone[0]
    assert worked == [1, 0, 9]
    assert len(journal.read_text().splitlines()) == 1 + len(TRIALS)


def test_trials_that_are_kept_are_not_run_again_whichever_are_asked_for(alone, monkeypatch):
    rows, journal = alone
    monkeypatch.setattr(running, "work_on", lambda job, rows: pytest.fail("a trial was run again"))
    assert run_trials("minimal", [TRIALS[2], TRIALS[0], TRIALS[2]], journal=journal) == [rows[2], rows[0], rows[2]]


def test_trials_of_another_domain_or_program_are_not_taken_for_these(alone, monkeypatch):
    _, journal = alone
    with pytest.raises(CasperError, match="another domain, or another version of casper"):
        run_trials("kitchen", [], journal=journal)
    monkeypatch.setattr(running, "code", lambda: "older")
    with pytest.raises(CasperError, match="another domain, or another version of casper"):
        run_trials("minimal", [], journal=journal)


def test_a_worker_that_dies_is_told_and_what_was_finished_is_kept(alone, tmp_path, monkeypatch):
    pytest.importorskip("joblib", reason="several jobs need joblib: pip install 'casper-hri[batch]'")

    def dies(job, rows):
        os._exit(1)

    journal = tmp_path / "trials.jsonl"
    journal.write_text("\n".join(alone[1].read_text().splitlines()[:2]) + "\n")
    monkeypatch.setattr(running, "work_on", dies)
    with pytest.raises(CasperError, match="a worker died"):
        run_trials("minimal", TRIALS, jobs=2, journal=journal)
    assert json.loads(journal.read_text().splitlines()[1])["trial"] == TRIALS[0]


def test_a_worker_with_another_program_is_refused(alone):
    with pytest.raises(CasperError, match="a worker has another version of casper"):
        running._work("another", running.work_on, None, [])


def test_two_runs_do_not_write_to_one_journal(tmp_path):
    pytest.importorskip("fcntl", reason="there are no such locks on this system")
    first = running._journal(tmp_path / "trials.jsonl", Domain.load("minimal"))
    with pytest.raises(CasperError, match="another run that is under way writes to"):
        run_trials("minimal", [], journal=tmp_path / "trials.jsonl")
    first.close(finished=False)
    assert run_trials("minimal", [], journal=tmp_path / "trials.jsonl") == []


def test_settings_are_changed_in_a_copy_alone():
    kitchen = Domain.load("kitchen")
    other = altered(kitchen, {"sensor.noise": 0.06, "human.walk_speed": 0.9, "tracking.steady": False})
    assert scene_of(other).sensor.noise == 0.06 and scene_of(other).human_settings.walk_speed == 0.9
    assert scene_of(kitchen).sensor.noise == 0.01


@pytest.mark.parametrize("name", ["noise", "sensor.", ".noise"])
def test_a_setting_is_named_by_its_stage_and_its_name(name):
    with pytest.raises(CasperError, match="as in sensor"):
        altered(Domain.load("minimal"), {name: 1})
