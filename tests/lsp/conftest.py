"""One server for all tests of a process: it starts once, as in an editor."""

import shutil
from pathlib import Path

import pytest

SHIPPED = Path(__file__).resolve().parents[2] / "domains"


@pytest.fixture(scope="session")
def editor():
    pytest.importorskip("pygls")
    from editor import Editor

    made = Editor()
    yield made
    made.end()


@pytest.fixture
def kitchen(tmp_path):
    """A copy of the kitchen that may be changed."""
    folder = tmp_path / "kitchen"
    shutil.copytree(SHIPPED / "kitchen", folder)
    return folder


@pytest.fixture
def home(tmp_path):
    """A folder with a small domain."""
    (tmp_path / "ontology.pl").write_text(ONTOLOGY)
    (tmp_path / "plans.pl").write_text(PLANS)
    return tmp_path


ONTOLOGY = """\
% --- people ---------------------------------------------
% Whoever lives here.
human(ann).
robot(tia).
agent(X) :- human(X).       % people act
agent(X) :- robot(X).
cup(mug). cup(glass).
place(table). place(sink).

% to carry something somewhere
carry(A, T, D) :- agent(A), cup(T), place(D).
fill(A, T, D) :- human(A), cup(T), place(D), D = table.
never("the mug stays at the table") :- claim(carry(_, mug, D)), D = sink.
setting(agents, partner, ann).
say(carry(A, T, D), "{A} carries {T} to {D}").
"""
PLANS = """\
goal(tea(C)) :- cup(C).
tea(C) --> serve(C), optional(fill(C, table)).
serve(C) --> carry(C, table).
"""
