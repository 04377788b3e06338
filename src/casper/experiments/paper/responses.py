"""Responses of the action machines: how alike each is to what was seen so far, step by step, and who wins when."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import Any

from casper.engine.actions.actions import action_recogniser
from casper.engine.actions.prediction import ActionSettings, action_settings
from casper.engine.movements.movements import Movement
from casper.experiments.experiment import Asked, Data, Experiment, Ran, Row, table
from casper.experiments.figures.responses import responses_figure
from casper.experiments.printed import SEQUENCES, WINNERS

KINDS = {
    "the paper's letters": {"recogniser": "ratcliff", "letters": "first"},
    "a letter a movement": {"recogniser": "ratcliff", "letters": "own"},
    "hidden Markov model": {"recogniser": "hmm"},
}
"""Recognisers that are compared, as settings: the first compares first letters, so that pick and place are alike."""

PERIOD = 0.5  # seconds between two world states


def work(asked: Asked, ran: Ran) -> Data:
    """Feed the paper's three sequences to each recogniser."""
    settings = action_settings(asked.domain.kb.rows)
    rows = [row for kind in KINDS for name in SEQUENCES for row in _steps(asked, settings, kind, name)]
    summary = [_winner(rows, kind, name) for kind in KINDS for name in SEQUENCES]
    return Data("responses", {"recognisers": len(KINDS)}, summary, rows, {"sequences": SEQUENCES})


def _steps(asked: Asked, settings: ActionSettings, kind: str, name: str) -> Iterator[Row]:
    chosen: dict[str, Any] = KINDS[kind]
    recogniser = action_recogniser(asked.domain.kb.rows, replace(settings, **chosen))
    looks = round(settings.lasts / PERIOD) if chosen["recogniser"] == "hmm" else 1
    for step, movement in enumerate(SEQUENCES[name]):
        seen = [recogniser.update(Movement((step * looks + at) * PERIOD, movement)) for at in range(looks)]
        standing = next((prediction for prediction in reversed(seen) if prediction is not None), None)
        wins = None if standing is None else standing.action
        for action, score in recogniser.scores.items():
            told = {"recogniser": kind, "sequence": name, "step": step, "movement": movement, "action": action}
            yield {**told, "score": round(score, 6), "wins": wins}


def _winner(rows: list[Row], kind: str, name: str) -> Row:
    of = [row for row in rows if row["recogniser"] == kind and row["sequence"] == name and row["wins"] is not None]
    first = of[0] if of else {"step": None, "wins": None}
    told = {"recogniser": kind, "sequence": name, "winner": first["wins"], "step": first["step"]}
    return {**told, "printed step": WINNERS[name]}


def says(data: Data) -> Iterator[str]:
    """Who wins when."""
    cells = ((r["recogniser"], r["sequence"], r["printed step"], r["step"], r["winner"]) for r in data.summary)
    yield table(("recogniser", "sequence", "printed step", "ours", "winner"), cells)
    yield (
        "Steps count from 0. The paper's figure comes out where movements are compared by their first letters, so "
        "that pick and place are the same; the kitchen gives each a letter of its own, and one sequence wins a step "
        "later. The hidden Markov model, the default, counts time, so for it each movement lasts as long as one does "
        "on average (6 s)."
    )


RESPONSES = Experiment(
    "responses",
    "which action the machines take three rows of movements for, and when",
    'figure "ensemble"',
    work,
    says,
    {"responses": responses_figure},
)
