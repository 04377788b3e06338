"""The trial of mutants, on a small project of its own: what a test states is noticed, what none states is not."""

import subprocess
import sys
from pathlib import Path

import pytest
from mutations import mutants_of, sample
from trial import Trial, relevant_tests

HERE = Path(__file__).resolve().parent

CODE = '''"""Who may enter."""


def may_enter(age: int, limit: int = 18) -> bool:
    """Whether somebody of this age may."""
    return age >= limit
'''

TESTS = """from casper.toy.door.entry import may_enter


def test_children_may_not_enter():
    assert may_enter(20) is True
    assert not may_enter(3)
"""


@pytest.fixture
def project(tmp_path):
    (tmp_path / "toy/door").mkdir(parents=True)
    (tmp_path / "tests/toy/door").mkdir(parents=True)
    (tmp_path / "src/casper").mkdir(parents=True)
    (tmp_path / "src/casper/__init__.py").touch()
    (tmp_path / "src/casper/toy").symlink_to("../../toy")
    (tmp_path / "toy/door/entry.py").write_text(CODE)
    (tmp_path / "tests/toy/door/test_entry.py").write_text(TESTS)
    return tmp_path


def mutation(project, *arguments):
    command = [sys.executable, str(HERE), "toy", "--root", str(project), *arguments]
    return subprocess.run(command, capture_output=True, text=True)


def test_what_no_test_states_survives_and_what_one_states_is_noticed(project):
    done = mutation(project)
    assert [line.split("  [")[0] for line in done.stdout.splitlines()] == [
        "survived  toy/door/entry.py:4: 18 → (19)",
        "survived  toy/door/entry.py:4: 18 → (17)",
        "noticed   toy/door/entry.py:6: return age >= limit → return None",
        "survived  toy/door/entry.py:6: age >= limit → (age > limit)",
        "toy: 1 of 4 noticed (0 by running out of time)",
    ]
    assert done.returncode == 1
    assert (project / "toy/door/entry.py").read_text() == CODE  # the tree one works in stays as it is


def test_the_seed_says_which_are_drawn(project):
    draws = [[str(mutant) for mutant in sample(project, "toy", 2, seed)] for seed in (1, 1, 2, 3, 4)]
    assert all(len(draw) == 2 for draw in draws)
    assert draws[0] == draws[1]
    assert len(set(map(tuple, draws))) > 1


def test_what_is_left_out_is_not_drawn(project):
    assert sample(project, "toy", 9, 0, ["toy/door"]) == []
    assert len(sample(project, "toy", 9, 0, ["toy/do"])) == 4


def test_tests_that_never_end_notice_by_running_out_of_time(project, tmp_path_factory):
    (project / "tests/toy/test_loop.py").write_text("def test_loop():\n    while True:\n        pass\n")
    trial = Trial(project, tmp_path_factory.mktemp("trial") / "copy")
    assert trial.failure(("tests/toy/test_loop.py",), 3) == ""


def test_tests_that_fail_without_a_mutant_say_nothing(project):
    (project / "tests/toy/door/test_entry.py").write_text(TESTS.replace("not may_enter", "may_enter"))
    done = mutation(project)
    assert done.returncode == 2
    assert "test_children_may_not_enter" in done.stderr


def changes(line):
    return [f"{mutant.before} → {mutant.after}" for mutant in mutants_of(line.encode(), "x.py")]


@pytest.mark.parametrize(
    ("line", "mutants"),
    [
        ("x = a < b", ["a < b → (a <= b)"]),
        ("x = a is not b", ["a is not b → (a is b)"]),
        ("x = a + b", ["a + b → (a - b)"]),
        ("x = a or b", ["a or b → (a and b)"]),
        ("x = True", ["True → (False)"]),
        ("x = 1.5", ["1.5 → (2.5)", "1.5 → (0.5)"]),
        ("x = not a", ["not a → (a)"]),
        ("if a: x = b", ["a → (not a)"]),
        ("if a == b: x = c", ["a == b → (a != b)"]),
        ("x = [a for a in b if a]", ["a → (not a)"]),
        ("while a: break", ["a → (not a)", "break → continue"]),
        ("a.clear()", ["a.clear() → pass"]),
        ("a.size += b", ["a.size += b → pass"]),
        ("def f(): return 'ä', a < b", ["return 'ä', a < b → return None", "a < b → (a <= b)"]),
        ("def f(x: Literal[1]): 'Says 1.'", []),
        ("@cache(1)\ndef f(): return None", []),
        ("if TYPE_CHECKING: import x", []),
        ("x = f'{a + b}'", []),
    ],
)
def test_a_line_has_these_mutants(line, mutants):
    assert changes(line) == mutants


@pytest.mark.parametrize(
    ("path", "tests"),
    [
        ("toy/door/entry.py", [("tests/toy/door",), ("tests/toy",)]),
        ("toy/window/pane.py", [("tests/toy",)]),
        ("toy/house.py", [("tests/toy/test_house.py",), ("tests/toy",)]),
    ],
)
def test_the_tests_of_the_room_come_first(project, path, tests):
    (project / "tests/toy/test_house.py").touch()
    assert relevant_tests(project, path) == tests
    assert relevant_tests(project, path, quick=True) == tests[:1]
