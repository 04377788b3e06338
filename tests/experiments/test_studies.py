"""The studies: a condition is a row of settings; what is counted is counted of the right trials."""

from casper.batch.judging import trial_settings
from casper.engine.domain.altering import altered
from casper.engine.domain.domain import Domain
from casper.experiments.experiment import Asked
from casper.experiments.registry import EXPERIMENTS
from casper.experiments.studies.certainty import VALUES
from casper.experiments.studies.conditions import FACTORS, Condition, crossed, one_at_a_time, usual
from casper.experiments.studies.many import is_good
from casper.experiments.trials import trials_of
from casper.sim_adapter.room.facts import scene_of

KITCHEN = Domain.load("kitchen")
ASKED = Asked(KITCHEN, 3, 7)
CONDITIONS = [*one_at_a_time(), *crossed()]


def outcome(trial, **told):
    """What could have become of a trial."""
    usual_ = {
        "right": True, "predicted": trial["goal"], "prediction_time": 12.0, "observed": 1, "missed": 0, "waiting": 1,
        "planned": 2, "helped": True, "gave_up": None, "help_ended": True, "wrong_announcements": 0,
        "wrong_interventions": [], "withdrawn": 0, "partner_finished": 30.0 if trial.get("robot", True) else 50.0,
        "seconds": 70.0, "least_distance": 0.4, "speed_there": 0.1, "behaves": None, "mistake": None,
    }  # fmt: skip
    return {"trial": dict(trial), **usual_, **told}


def ran(**told):
    return lambda trials: [outcome(trial, **told) for trial in trials]


def test_the_first_trials_of_many_are_those_of_few():
    assert trials_of(Asked(KITCHEN, 9, 5), 1)[:4] == trials_of(Asked(KITCHEN, 4, 5), 1)
    assert [trial["goal"] for trial in trials_of(Asked(KITCHEN, None, 0), 3)] == list(KITCHEN.library.goals)


def test_every_condition_has_a_name_of_its_own_and_settings_that_there_are():
    assert len({c.name for c in crossed()}) == len(list(crossed())) and next(one_at_a_time()).name == "as it is"
    for condition in one_at_a_time():
        for trial in condition.trials(ASKED, 1):
            settings = trial.pop("settings", {})
            trial_settings(trial)
            scene_of(altered(KITCHEN, settings))


def test_the_first_level_of_each_factor_changes_nothing():
    assert Condition({factor: usual(factor) for factor in FACTORS}).trials(ASKED, 1) == trials_of(ASKED, 1)


def test_all_conditions_see_the_same_seeds():
    seeds = {tuple(trial["seed"] for trial in condition.trials(ASKED, 1)) for condition in CONDITIONS}
    assert seeds == {(7, 8, 9)}


def test_who_is_alone_is_the_same_partner_at_the_same_pace_whoever_looks_on():
    poor = Condition({**next(one_at_a_time()).levels, "sensor": "6 cm noise", "walking": "1.0 m/s", "verification": "off"})
    (trial, *_) = poor.alone.trials(ASKED, 1, robot=False)
    assert trial["settings"] == {"human.walk_speed": 1.0} and trial["robot"] is False and "verification" not in trial


def test_the_study_compares_each_trial_with_the_same_partner_alone():
    data = EXPERIMENTS["study"].work(ASKED, ran())
    assert {row["saved"] for row in data.rows} == {20.0}
    assert len(data.rows) == 3 * len(data.summary) and all(row["trials"] == 3 for row in data.summary)
    assert {row["walking"] for row in data.rows if row["condition"] == "walking: 1.0 m/s"} == {"1.0 m/s"}


def test_a_study_of_trials_that_broke_off_says_so():
    lost = dict.fromkeys(outcome({"goal": "lunch"}))
    data = EXPERIMENTS["study"].work(ASKED, lambda trials: [{**lost, "trial": t, "mistake": "broke off"} for t in trials])
    assert all((row["broken off"], row["right"], row["saved"]) == (3, 0, None) for row in data.summary)
    assert all("broken off" in text or "trials" in text for text in EXPERIMENTS["study"].says(data))


def test_the_knob_is_turned_over_the_same_seeds():
    data = EXPERIMENTS["certainty"].work(ASKED, ran(withdrawn=1))
    assert [row["certainty"] for row in data.summary] == list(VALUES)
    assert all((row["trials"], row["came to nothing"]) == (3, 3) for row in data.summary)


def test_a_wrong_intervention_is_no_good_trial_even_where_the_goal_was_read():
    good = outcome({"goal": "lunch", "seed": 1})
    assert is_good(good) and not is_good({**good, "wrong_interventions": ["wash(glass, sink)"]})
    assert not is_good({**good, "helped": False}) and not is_good({**good, "right": None})


def test_many_trials_name_each_one_that_went_wrong():
    told = EXPERIMENTS["many"]
    data = told.work(ASKED, lambda trials: [outcome(t, right=t["goal"] != "lunch", predicted="drink") for t in trials])
    text = "\n\n".join(told.says(data))
    assert "- lunch, seed 9: read as drink" in text and "66.67%" in text


def test_another_body_of_the_robot_is_a_setting_of_every_trial_and_told():
    asked = Asked(KITCHEN, 2, 7, "tiago")
    assert [trial["body"] for trial in trials_of(asked, 1)] == ["tiago", "tiago"]
    assert asked.first == {"first seed": 7, "robot": "tiago"} and ASKED.first == {"first seed": 7}
    assert all("body" not in trial for trial in trials_of(ASKED, 1))
