"""The contract and the plugin: planted bugs are found, each with a counterexample that one can read."""

import subprocess
import sys
from importlib.metadata import entry_points
from pathlib import Path

import pytest
from home import BUGS, home

from casper.engine.domain.domain import Domain
from casper.testing.contract import DomainContract, PlannerContract, RecogniserContract

KITCHEN = Domain.load("kitchen")
SUITE = '''
from casper.engine.domain.domain import Domain
from casper.testing.contract import DomainContract

class TestHome(DomainContract):
    domain = Domain.load({folder!r})

    def expected(self, statement):
        if statement.functor == "boil":
            return statement[1] == "ann" and statement[2] == "pot"
        return None
'''


def run(folder: Path, *arguments: str) -> tuple[int, str]:
    """A run of pytest in another process, as a foreign project would."""
    installed = any(point.name == "casper" for point in entry_points(group="pytest11"))
    plugin = [] if installed else ["-p", "casper.testing.plugin"]
    command = [sys.executable, "-m", "pytest", *plugin, "-q", "-p", "no:cacheprovider", *arguments]
    done = subprocess.run(command, capture_output=True, text=True, cwd=folder, timeout=300)
    return done.returncode, done.stdout + done.stderr


FOUND = {
    "a rule too weak": "boil(ann, mug)",
    "a rule too strong": "nobody can do step 3, sip(tea, mug): mug is not glass",
    "a plan with swapped steps": "nobody can do step 1, brew(tea, mug)",
    "a constraint that never fires": 'never fires: "tea is for the mug"',
    "a goal that hides another": "rinse is hidden by clean: seen wash(mug)",
}


@pytest.mark.parametrize("bug", BUGS)
def test_each_planted_bug_is_found_by_the_contract(tmp_path: Path, bug: str) -> None:
    folder = tmp_path / "home"
    folder.mkdir()
    home(folder, bug)
    (tmp_path / "test_home.py").write_text(SUITE.format(folder=str(folder)), encoding="utf-8")
    code, told = run(tmp_path, "--casper-profile", "quick")
    assert code == 1 and FOUND[bug] in told


def test_a_domain_without_a_bug_keeps_the_contract(tmp_path: Path) -> None:
    folder = tmp_path / "home"
    folder.mkdir()
    home(folder)
    (tmp_path / "test_home.py").write_text(SUITE.format(folder=str(folder)), encoding="utf-8")
    code, told = run(tmp_path, "--casper-profile", "quick")
    assert code == 0, told


def test_the_plugin_alone_finds_four_of_the_five(tmp_path: Path) -> None:
    found = []
    for number, bug in enumerate(BUGS):
        folder = tmp_path / f"home{number}"
        folder.mkdir()
        code, told = run(tmp_path, "--casper-domain", str(home(folder, bug)), "--casper-profile", "quick")
        if code == 1 and FOUND[bug] in told:
            found.append(bug)
            assert "Traceback" not in told and "Falsifying" not in told
    assert found == [bug for bug in BUGS if bug != "a rule too weak"]


def test_the_plugin_passes_a_good_domain_and_names_its_tests(tmp_path: Path) -> None:
    code, told = run(tmp_path, "--casper-domain", str(home(tmp_path)), "--casper-profile", "quick", "-vv")
    assert code == 0, told
    assert "constraints_can_fire" in told and "example boil(pot) reads as tea" in told


def test_a_domain_that_does_not_load_is_one_failure_with_its_place(tmp_path: Path) -> None:
    (home(tmp_path) / "plans.pl").write_text("tea --> ", encoding="utf-8")
    code, told = run(tmp_path, "--casper-domain", str(tmp_path))
    assert code == 1 and "plans.pl:1" in told and "1 failed" in told


def test_an_example_that_fails_is_told_at_its_line(tmp_path: Path) -> None:
    (home(tmp_path) / "tests.pl").write_text("\nexample(valid, boil(bot, pot)).\n", encoding="utf-8")
    code, told = run(tmp_path, "--casper-domain", str(tmp_path), "--casper-profile", "quick")
    assert code == 1 and "bot is not a human" in told


def test_a_profile_that_nobody_knows_is_told(tmp_path: Path) -> None:
    code, told = run(tmp_path, "--casper-domain", str(home(tmp_path)), "--casper-profile", "slow")
    assert code == 4 and "quick, standard, thorough" in told


class TestTheKitchen(DomainContract):
    domain = KITCHEN


class TestOurOwnRecogniser(RecogniserContract):
    domain = KITCHEN

    def recogniser(self):
        return self.domain.reading()


class TestOurOwnPlanner(PlannerContract):
    domain = KITCHEN

    def plan(self, reading):
        plan = reading.plan_for("tiago")
        return () if plan is None else plan.actions


class Stubborn:
    """A recogniser that always says the same, and not even that it is sure."""

    @property
    def posterior(self) -> dict[str, float]:
        return {"lunch": 0.5, "dinner": 0.25}

    def observe(self, action: str) -> None:
        pass


def test_a_recogniser_that_breaks_the_laws_is_found_out() -> None:
    class Mine(RecogniserContract):
        domain = KITCHEN

        def recogniser(self):
            return Stubborn()

    for law, words in (
        (Mine().test_shares_sum_to_one, "sum to 0.75"),
        (Mine().test_goals_are_those_of_the_library, "no goals dinner"),
        (Mine().test_a_goal_leads_when_it_was_pursued, "breakfast its share is 0.0"),
    ):
        with pytest.raises(AssertionError, match=words):
            law()


def test_a_planner_that_gives_the_robot_what_it_cannot_do_is_found_out() -> None:
    class Mine(PlannerContract):
        domain = KITCHEN

        def plan(self, reading):
            return ["eat(meal, plate)"]

    with pytest.raises(AssertionError, match="tiago is not a human"):
        Mine().test_every_step_is_valid_for_the_robot()
