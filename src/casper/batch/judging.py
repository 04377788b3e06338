"""What became of a trial: one row of figures, for tables of many (paper section V-E, and what people care about)."""

from __future__ import annotations

import gc
from collections.abc import Mapping
from dataclasses import fields
from typing import TYPE_CHECKING, Any

from casper.engine.domain.domain import Domain
from casper.engine.events import Event
from casper.kb.errors import CasperError, DomainError
from casper.sim_adapter.room.scene import BODY

if TYPE_CHECKING:
    from casper.sim_adapter.trial import Trial, TrialSettings

FIGURES = (
    "behaves",
    "right",
    "predicted",
    "prediction_time",
    "observed",
    "missed",
    "waiting",
    "planned",
    "helped",
    "gave_up",
    "help_ended",
    "wrong_announcements",
    "wrong_interventions",
    "withdrawn",
    "partner_finished",
    "seconds",
    "least_distance",
    "speed_there",
)
"""The columns of `judged`; units are seconds, metres and metres a second.

behaves: in which ways the partner is out of the ordinary. right: the goals that were read are those they pursued;
predicted, prediction_time, observed, missed, waiting, planned: the paper's, of the goal committed to last. helped: the
robot's part is physically finished; gave_up: why it ended without that, if the robot said so; help_ended: whether
everything that was announced was done, or given up for a reason that is true. wrong_announcements: how often a goal was
announced that the partner never had; wrong_interventions: what the robot took hold of for a step that was left to be
done of no goal they had (`casper.sim_adapter.truth`). partner_finished: when the last action of their own was over;
seconds: when the trial was. least_distance and speed_there: how near the robot came to a person while it moved, and how
fast it was there; None where it never did. A trial that the simulation had to break off is no row but a mistake.
"""


def trial_settings(given: Mapping[str, Any]) -> TrialSettings:
    """The settings of a trial, from a row.

    Raises:
        DomainError: there is no such setting.
    """
    from casper.sim_adapter.trial import TrialSettings

    known = {field.name for field in fields(TrialSettings)}
    unknown = [name for name in given if name not in known]
    if unknown:
        raise DomainError(f"a trial has no {unknown[0]}; it has {', '.join(sorted(known))}")
    return TrialSettings(**given)


def judged(domain: Domain, settings: TrialSettings) -> dict[str, Any]:
    """Run a trial; what became of it (`FIGURES`).

    Raises:
        CasperError: the trial cannot be run, or something in it went wrong: the sentence says what.
    """
    try:
        return _judged(*_carried_out(domain, settings))
    except (CasperError, MemoryError):
        raise
    except Exception as mistake:  # a trial that breaks must not end the thousand others
        first = (str(mistake).strip() or "no reason given").splitlines()[0]
        raise CasperError(f"the trial broke off: {type(mistake).__name__}: {first}") from mistake
    finally:
        if settings.body != BODY:
            gc.collect()  # meshes are tens of megabytes, and a trial refers to itself, so that nothing else frees it


def _carried_out(domain: Domain, settings: TrialSettings) -> tuple[Trial, list[Event]]:
    from casper.sim_adapter.trial import Trial

    trial = Trial(domain, settings)
    return trial, list(trial.events())


def _judged(trial: Trial, events: list[Event]) -> dict[str, Any]:
    told = events[-1].data
    robot, truth = told["robot"], told["truth"]
    pursuits = [pursuit for partner in trial.partners.values() for pursuit in partner.pursuits]
    goals = {goal for pursuit in pursuits for goal in pursuit.stretch.goals}
    if "ended" in told:
        raise CasperError(told["ended"])
    announced = [event.data["goal"] for event in events if event.type == "prediction"]
    helped, reasons = bool(robot["done"]), robot["gave_up"]
    return {
        "behaves": " and ".join(trial.behaviours) or None,
        "right": bool(truth["right"]),
        **{name: told[name] for name in FIGURES[2:8]},
        "helped": helped,
        "gave_up": None if helped or not reasons else "; ".join(dict.fromkeys(reasons)),
        "help_ended": bool(truth["help_ended"]),
        "wrong_announcements": sum(not goals.issuperset(goal.split(" + ")) for goal in announced),
        "wrong_interventions": list(truth["wrong_interventions"]),
        "withdrawn": sum(event.type == "withdrawn" for event in events),
        "partner_finished": told["partner_finished"],
        "seconds": events[-1].t,
        "least_distance": robot.get("least_distance"),
        "speed_there": robot.get("speed_at_least_distance"),
    }
