"""How the mind holds under poor sensors: simulated trials of the kitchen, a row a sensor, measured and kept.

    python benchmarks/perception/robustness.py [--seeds 15] [--first 400] [--rows noise_6,cheap] [--jobs 2]
        [--out FILE.csv] [--plot FILE.png]

Right: the last goal announced is what the partner wants. Helped: the robot's part is physically finished. Wrong: trials
in which another goal was ever announced, or the robot did what is no step of the partner's plan, or set off before the
partner had begun the last step of their own.
"""

import argparse
import csv
import sys
from dataclasses import replace
from pathlib import Path

from joblib import Parallel, delayed

from casper import Domain
from casper.sim_adapter.trial import Trial, TrialSettings

GOALS = ("breakfast", "drink", "lunch")
ROWS: dict[str, tuple[float, dict[str, float]]] = {
    "default": (0.5, {}),
    "noise_3": (0.5, {"noise": 0.03}),
    "noise_6": (0.5, {"noise": 0.06}),
    "noise_10": (0.5, {"noise": 0.10}),
    "drop_30": (0.5, {"drop": 0.3}),
    "drop_60": (0.5, {"drop": 0.6}),
    "period_0.1": (0.1, {}),
    "period_2": (2.0, {}),
    "misread_10": (0.5, {"hold_misread": 0.1}),
    "heading_15": (0.5, {"heading_noise": 15.0}),
    "view_50": (0.5, {"field_of_view": 50.0}),
    "cheap": (0.2, {"noise": 0.04, "drop": 0.3, "hold_misread": 0.1}),
}
TELLS = {
    "default": "the kitchen's own: 1 cm, 2 % lost, 1 % misread, 2 Hz",
    "cheap": "cheap camera: 4 cm, 30 % lost, 10 % misread, 5 Hz",
}
COLUMNS = ("row", "seed", "goal", "right", "helped", "wrong", "t")


def trial(row: str, seed: int) -> dict[str, object]:
    """One trial: what became of it, and when the goal was known (seconds)."""
    period, sensor = ROWS[row]
    goal = GOALS[seed % len(GOALS)]
    made = Trial(Domain.load("kitchen"), TrialSettings(goal=goal, seed=seed))
    simulation = made.simulation
    simulation.sensor.settings = replace(simulation.sensor.settings, **sensor)
    simulation.scene = replace(simulation.scene, sim=replace(simulation.scene.sim, period=period))
    steps, wrong = {str(scripted.action) for scripted in made.script}, False
    for event in made.events():
        if event.type == "prediction":
            wrong = wrong or event.data["goal"] != goal
        if event.type == "robot" and event.data["status"] == "asked":
            wrong = wrong or not last_is_begun(made)
        last = event
    wrong = wrong or any(str(action) not in steps for action in made.helper.asked)
    told = last.data
    figures = {"right": told["correct"], "helped": told["robot"]["done"], "wrong": wrong}
    return {"row": row, "seed": seed, "goal": goal, **figures, "t": told["prediction_time"]}


def last_is_begun(made: Trial) -> bool:
    """Whether the partner has begun the last step that the robot leaves to them."""
    own = [scripted.step for scripted in made.script if scripted.action not in made.helper.asked]
    human = made.partner.human
    return not own or human.current == own[-1] or own[-1] in human.done


def line(row: str, found: list[dict]) -> str:
    count = len(found)
    right, helped, wrong = (sum(bool(r[name]) for r in found) for name in ("right", "helped", "wrong"))
    times = [r["t"] for r in found if r["right"] and r["t"] is not None]
    mean = f"{sum(times) / len(times):7.1f} s" if times else "      –"
    return f"{row:<12}{count:6}{right:8}{helped:8}{wrong:8}{mean}  {TELLS.get(row, '')}"


def plot(found: list[dict], file: Path) -> None:
    """Shares of right goals and finished help, a pair of bars a row."""
    import matplotlib

    matplotlib.use("Agg")
    from matplotlib import pyplot

    rows = list(dict.fromkeys(r["row"] for r in found))
    figure, axes = pyplot.subplots(figsize=(9, 3.2))
    for shift, name in ((-0.2, "right"), (0.2, "helped")):
        shares = [
            sum(bool(r[name]) for r in found if r["row"] == row) / sum(r["row"] == row for r in found) for row in rows
        ]
        axes.bar([at + shift for at in range(len(rows))], shares, 0.38, label=name)
    axes.set_xticks(range(len(rows)), rows, rotation=30, ha="right")
    axes.set_ylim(0, 1.05)
    axes.set_ylabel("share of trials")
    axes.legend(loc="lower left")
    figure.tight_layout()
    figure.savefig(file)


def main() -> int:
    """Print the table; exit code 1 when something wrong was announced or done."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=15)
    parser.add_argument("--first", type=int, default=400)
    parser.add_argument("--rows", default=",".join(ROWS))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--plot", type=Path)
    given = parser.parse_args()
    rows = given.rows.split(",")
    unknown = [row for row in rows if row not in ROWS]
    if unknown:
        parser.error(f"there is no row {unknown[0]}; there are {', '.join(ROWS)}")
    print(f"{'row':<12}{'trials':>6}{'right':>8}{'helped':>8}{'wrong':>8}{'known at':>9}")
    every: list[dict] = []
    for row in rows:
        seeds = range(given.first, given.first + given.seeds)
        found = Parallel(n_jobs=given.jobs)(delayed(trial)(row, seed) for seed in seeds)
        every += found
        print(line(row, found), flush=True)
        if given.out is not None:
            with given.out.open("w", newline="") as file:
                writer = csv.DictWriter(file, COLUMNS)
                writer.writeheader()
                writer.writerows(every)
    if given.plot is not None:
        plot(every, given.plot)
    return 1 if any(r["wrong"] for r in every) else 0


if __name__ == "__main__":
    sys.exit(main())
