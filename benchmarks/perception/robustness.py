"""How the mind holds under poor sensors: simulated trials of the kitchen, a row a sensor, as a table and a plot.

    python benchmarks/perception/robustness.py [--seeds 20] [--first 400] [--rows noise_6,cheap] [--jobs 2]
        [--out FOLDER] [--redraw]

Right: the last goal announced is what the partner wants. Helped: the robot's part is physically finished. Wrong: trials
in which another goal was ever announced, or the robot did what is no step of the partner's plan, or set off before the
partner had begun the last step of their own. Brackets and bars: Wilson's 95 % interval.

With a folder every trial is kept there as it comes (trials.jsonl), so that a run which was interrupted goes on and
more seeds add to those that are there; the table (robustness.md) and the plot (robustness.svg, .png; needs [plot]) are
made of what it has. ``--redraw`` only does that.
"""

import argparse
import sys
from collections.abc import Iterable, Iterator, Mapping
from dataclasses import replace
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))

from joblib import Parallel, delayed
from robustness_figure import figure
from sensors import Sensor, sensors

from casper import Domain
from casper.batch.journal import Journal
from casper.batch.trials import code
from casper.engine.domain.digest import digest
from casper.experiments.figures.style import save
from casper.experiments.statistics import share_interval
from casper.kb.errors import CasperError
from casper.sim_adapter.trial import Trial, TrialSettings

GOALS = ("breakfast", "drink", "lunch")
COUNTED = ("right", "helped", "wrong")
Outcome = Mapping[str, object]


def trial(sensor: Sensor, seed: int) -> dict[str, object]:
    """One trial: what became of it, and when the goal was known (seconds)."""
    goal = GOALS[seed % len(GOALS)]
    made = Trial(Domain.load("kitchen"), TrialSettings(goal=goal, seed=seed))
    simulation = made.simulation
    simulation.sensor.settings = replace(simulation.sensor.settings, **sensor.eye)
    simulation.scene = replace(simulation.scene, sim=replace(simulation.scene.sim, period=sensor.period))
    steps, wrong = {str(scripted.action) for scripted in made.script}, False
    for event in made.events():
        if event.type == "prediction":
            wrong = wrong or event.data["goal"] != goal
        if event.type == "robot" and event.data["status"] == "asked":
            wrong = wrong or not last_is_begun(made)
        last = event
    wrong = wrong or any(str(action) not in steps for action in made.helper.asked)
    told = last.data
    figures = {"right": bool(told["correct"]), "helped": bool(told["robot"]["done"]), "wrong": wrong}
    return {"row": sensor.name, "seed": seed, "goal": goal, **figures, "t": told["prediction_time"]}


def last_is_begun(made: Trial) -> bool:
    """Whether the partner has begun the last step that the robot leaves to them."""
    own = [scripted.step for scripted in made.script if scripted.action not in made.helper.asked]
    human = made.partner.human
    return not own or human.current == own[-1] or own[-1] in human.done


def opened(folder: Path) -> Journal:
    """The trials that a folder keeps: of this program and this kitchen alone, for a trial is what they make of it."""
    folder.mkdir(parents=True, exist_ok=True)
    header = {"robustness": 1, "domain": digest(Domain.load("kitchen")), "code": code()}
    advice = "choose another folder, or --redraw what it has"
    return Journal(folder / "trials.jsonl", header, key_of, "another kitchen, or another version of casper", advice)


def key_of(outcome: Outcome) -> tuple[object, object]:
    return outcome["row"], outcome["seed"]


def run(wanted: Iterable[tuple[Sensor, int]], jobs: int, journal: Journal | None) -> Iterator[Outcome]:
    """What became of trials, in their order; those that are kept are not run again."""
    done = {} if journal is None else journal.done
    every = list(wanted)
    left = [(sensor, seed) for sensor, seed in every if (sensor.name, seed) not in done]
    parallel = Parallel(n_jobs=jobs, return_as="generator")
    fresh = iter(parallel(delayed(trial)(sensor, seed) for sensor, seed in left))
    for sensor, seed in every:
        kept = done.get((sensor.name, seed))
        if kept is None:
            kept = next(fresh)
            if journal is not None:
                journal.add([kept])
        yield kept


def counted(row: str, found: Iterable[Outcome]) -> dict[str, object]:
    """The trials of a row, counted; ``known at`` is the mean of those that are right (seconds)."""
    mine = [outcome for outcome in found if outcome["row"] == row]
    times = [float(str(o["t"])) for o in mine if o["right"] and o["t"] is not None]
    counts = {name: sum(bool(outcome[name]) for outcome in mine) for name in COUNTED}
    return {"row": row, "trials": len(mine), **counts, "known at": sum(times) / len(times) if times else None}


def table(rows: Iterable[Mapping[str, object]]) -> Iterator[str]:
    """Lines of a table in Markdown."""
    known = sensors()
    yield "| sensor | trials | right goal | help finished | wrong | goal known at |"
    yield "|---|---|---|---|---|---|"
    for row in rows:
        count, at = int(str(row["trials"])), row["known at"]
        right, helped = (_share(int(str(row[name])), count) for name in ("right", "helped"))
        mean = "–" if at is None else f"{at:.1f} s"
        yield f"| {known[str(row['row'])].tells} | {count} | {right} | {helped} | {row['wrong']} | {mean} |"


def _share(hits: int, count: int) -> str:
    low, high = share_interval(hits, count)
    return f"{hits} ({100 * low:.0f}–{100 * high:.0f} %)"


def kept_in(folder: Path) -> list[Outcome]:
    """What a folder keeps, whichever program made it.

    Raises:
        CasperError: there is nothing.
    """
    import json

    file = folder / "trials.jsonl"
    if not file.exists():
        raise CasperError(f"there are no trials in {folder} to draw; run it without --redraw")
    lines = file.read_text(encoding="utf-8").splitlines()[1:]
    return [json.loads(line) for line in lines]


def main() -> int:
    """Print the table; exit code 1 when something wrong was announced or done."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--seeds", type=int, default=20)
    parser.add_argument("--first", type=int, default=400)
    parser.add_argument("--rows", default=",".join(sensors()))
    parser.add_argument("--jobs", type=int, default=2)
    parser.add_argument("--out", type=Path)
    parser.add_argument("--redraw", action="store_true")
    given = parser.parse_args()
    names, known = given.rows.split(","), sensors()
    unknown = [name for name in names if name not in known]
    if unknown:
        parser.error(f"there is no row {unknown[0]}; there are {', '.join(known)}")
    if given.redraw and given.out is None:
        parser.error("--redraw needs --out FOLDER, where the trials are")
    try:
        return _measured(given, [known[name] for name in names])
    except CasperError as mistake:
        print(mistake, file=sys.stderr)
        return 2


def _measured(given: argparse.Namespace, rows: list[Sensor]) -> int:
    found: list[Outcome] = []
    if given.redraw:
        found = kept_in(given.out)
    else:
        journal = None if given.out is None else opened(given.out)
        seeds = range(given.first, given.first + given.seeds)
        for outcome in run(((sensor, seed) for sensor in rows for seed in seeds), given.jobs, journal):
            found.append(outcome)
            if sys.stderr.isatty():
                print(f"\r{len(found)} of {len(rows) * given.seeds} trials", end="", file=sys.stderr)
        if journal is not None:
            journal.close(finished=False)
            found = kept_in(given.out)
    told = [row for row in (counted(name, found) for name in sensors()) if row["trials"]]
    print("\n".join(table(told)))
    if given.out is not None:
        (given.out / "robustness.md").write_text("\n".join(table(told)) + "\n", encoding="utf-8")
        save(figure, told, given.out / "robustness")
    return 1 if any(row["wrong"] for row in told) else 0


if __name__ == "__main__":
    sys.exit(main())
