"""``casper run --robot``: which body the simulated robot has."""

import pytest

pytest.importorskip("mujoco")

from casper.cli.terminal.options import bodies
from casper.sim_adapter.physics.bodies import package
from casper.sim_adapter.physics.bodies.table import BODIES


@pytest.fixture
def without_the_model(monkeypatch):
    monkeypatch.setattr(package, "find_spec", lambda name: None)


def test_a_body_that_there_is_not_is_one_sentence(casper):
    told = casper("run", "kitchen", "--robot", "pr2")
    assert told.code == 2 and told.out == ""
    assert told.err == "casper: the robot has no body pr2; there are primitive, tiago\n"


@pytest.mark.parametrize("command", [("run", "kitchen"), ("experiment", "results", "--out", "found")])
def test_a_model_that_is_missing_is_one_sentence_with_what_to_type(casper, without_the_model, command):
    told = casper(*command, "--robot", "tiago")
    assert told.code == 2 and told.out == ""
    assert told.err.startswith("casper: TIAGo's model comes with robosuite") and "pip install --no-deps" in told.err


def test_a_shell_completes_the_bodies_there_are():
    assert bodies("") == list(BODIES) and bodies("ti") == ["tiago"]
