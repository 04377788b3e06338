"""A foreign project: bugs planted in its domain are found, by its contract and by the plugin alone, and told shortly."""

from pathlib import Path

import pytest
from home import BUGS, SUITE, home
from runs import Run, run_all

pytestmark = pytest.mark.xdist_group("planted bugs")  # so that one worker has all the runs

FOUND = {
    "a rule too weak": "boil(ann, mug)",
    "a rule too strong": "nobody can do step 3, sip(tea, mug): mug is not glass",
    "a plan with swapped steps": "nobody can do step 1, brew(tea, mug)",
    "a constraint that never fires": 'never fires: "tea is for the mug"',
    "a goal that hides another": "rinse is hidden by clean: seen wash(mug)",
}
CLEAN, BROKEN, SURPRISED, UNKNOWN = "no bug", "a broken file", "a failing example", "an unknown profile"


@pytest.fixture(scope="module")
def runs(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Run]:
    """What came of the domain with each of the bugs, with none, and with other mistakes."""
    place = tmp_path_factory.mktemp("project")
    quick = ["--casper-profile", "quick", "--casper-domain"]
    wanted: dict[str, list[str]] = {}
    for number, bug in enumerate([CLEAN, *BUGS]):
        folder = made(place / f"home{number}", None if bug == CLEAN else bug)
        suite = place / f"test_home{number}.py"
        suite.write_text(SUITE.format(folder=str(folder)), encoding="utf-8")
        wanted[bug] = [str(suite), *quick, str(folder), "-vv"]
    (made(place / "broken") / "plans.pl").write_text("tea --> ", encoding="utf-8")
    (made(place / "surprised") / "tests.pl").write_text("\nexample(valid, boil(bot, pot)).\n", encoding="utf-8")
    wanted[BROKEN] = ["--casper-domain", str(place / "broken")]
    wanted[SURPRISED] = [*quick, str(place / "surprised"), "-k", "example"]
    wanted[UNKNOWN] = ["--casper-domain", str(place / "home0"), "--casper-profile", "slow"]
    elsewhere = place / "elsewhere"  # or what stands beside the domains would be collected, too
    elsewhere.mkdir()
    return run_all(wanted, str(elsewhere))


def made(folder: Path, bug: str | None = None) -> Path:
    folder.mkdir()
    return home(folder, bug)


@pytest.mark.parametrize("bug", BUGS)
def test_each_planted_bug_is_found_by_the_contract(runs: dict[str, Run], bug: str) -> None:
    assert runs[bug].found(FOUND[bug], "TestHome"), runs[bug].printed


def test_the_plugin_alone_finds_four_of_the_five(runs: dict[str, Run]) -> None:
    found = [bug for number, bug in enumerate(BUGS, 1) if runs[bug].found(FOUND[bug], f"home{number}::")]
    assert found == [bug for bug in BUGS if bug != "a rule too weak"]
    told = [said for bug in found for name, said in runs[bug].failed.items() if "TestHome" not in name]
    assert not any("Traceback" in said or "Falsifying" in said for said in told)


def test_a_domain_without_a_bug_keeps_the_contract_and_its_tests_have_names(runs: dict[str, Run]) -> None:
    assert runs[CLEAN].code == 0, runs[CLEAN].printed
    assert "constraints_can_fire" in runs[CLEAN].printed and "example boil(pot) reads as tea" in runs[CLEAN].printed


def test_a_domain_that_does_not_load_is_one_failure_with_its_place(runs: dict[str, Run]) -> None:
    assert runs[BROKEN].code == 1 and len(runs[BROKEN].failed) == 1 and "plans.pl:1" in runs[BROKEN].printed


def test_an_example_that_fails_is_told_at_its_line(runs: dict[str, Run]) -> None:
    assert runs[SURPRISED].found("bot is not a human", "surprised")


def test_a_profile_that_nobody_knows_is_told(runs: dict[str, Run]) -> None:
    assert runs[UNKNOWN].code == 4 and "quick, standard, thorough" in runs[UNKNOWN].printed
