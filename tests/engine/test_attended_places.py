"""Where an action happens, of places that are passed by or lie on one another: on hand-made world states."""

import pytest

from casper import Domain, Mind
from casper.engine.perception.world import AgentState, ObjectState, WorldState

ONTOLOGY = """
human(ann). robot(robbie). thing(cup). place(bowl). place(mat). place(tray).
put(A, T, P) :- human(A), thing(T), place(P).
"""
ACTIONS = ':- include("household.pl"). ' + "".join(
    f"context(pick_and_place, {p}, put). " for p in ("bowl", "mat", "tray")
)
SPOTS = {"cup": (1.0, 0.0, 0.8), "mat": (5.0, 0.0, 0.8), "bowl": (5.0, 0.0, 0.82), "tray": (4.2, 1.0, 0.8)}


@pytest.fixture
def room(tmp_path):
    """Makes a mind of the room with a few more clauses."""

    def made(more=""):
        (tmp_path / "ontology.pl").write_text(ONTOLOGY + more)
        (tmp_path / "plans.pl").write_text("laying --> put(cup, _).")
        (tmp_path / "actions.pl").write_text(ACTIONS)
        return Mind(Domain.load(tmp_path), helps=False)

    return made


def carried():
    """World states: ann stands at the cup, and carries it along the x axis to the mat with the bowl on it."""
    xs = [0.5] * 10 + [0.5 + 0.3 * step for step in range(1, 14)] + [4.4] * 8
    for at, x in enumerate(xs):
        held = at >= 8
        where = {**SPOTS, "cup": (x, 0.0, 1.0)} if held else SPOTS
        agent = AgentState(x, 0.0, 0.0, "cup" if held else None)
        yield WorldState(0.5 * at, {"ann": agent}, {name: ObjectState(*spot) for name, spot in where.items()})


def accepted(mind):
    told = [event for state in carried() for event in mind.update(state)]
    return [event.data["statement"] for event in told if event.type == "verdict" and event.data["valid"]]


def test_what_is_put_at_a_dish_on_a_panel_is_put_in_the_dish(room):
    assert accepted(room()) == ["put(ann, cup, bowl)"]


def test_unless_only_the_panel_may_have_it(room):
    assert accepted(room('never("nothing goes into the bowl") :- claim(put(_, _, bowl)).')) == ["put(ann, cup, mat)"]
