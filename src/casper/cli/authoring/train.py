"""``casper train``: learn the movements from trials, simulated or recorded, and write them as clauses."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from casper.cli.terminal.options import AsJson, DomainName, Quiet

if TYPE_CHECKING:
    from casper.engine.domain.domain import Domain
    from casper.engine.movements.tree import Evaluation
    from casper.engine.movements.watching import Recording
    from casper.kb.errors import CasperError


def train(
    domain: DomainName,
    trials: Annotated[int, typer.Option(min=2, max=1000, help="Scripted trials to learn from.")] = 10,
    seed: Annotated[int, typer.Option(help="Of the trials and the tree; the same seed gives the same file.")] = 1,
    leaves: Annotated[int | None, typer.Option(min=2, help="Leaves the tree may have; 5, with --timed 64.")] = None,
    timed: Annotated[
        bool,
        typer.Option("--timed", help="Look back, too: how long the hand has been full, whether it has been carried."),
    ] = False,
    noise: Annotated[
        list[float] | None, typer.Option(metavar="METRES", help="Of a sensor to learn for; may be repeated.")
    ] = None,
    period: Annotated[
        list[float] | None, typer.Option(metavar="SECONDS", help="Between its world states; may be repeated.")
    ] = None,
    trace: Annotated[
        list[Path] | None,
        typer.Option(metavar="FILE", help="Learn from labelled recordings instead (.jsonl, .csv, .parquet)."),
    ] = None,
    plans: Annotated[
        list[Path] | None,
        typer.Option(metavar="FILE", help="Learn the prices of plans instead, from a recorded day; may be repeated."),
    ] = None,
    output: Annotated[
        Path | None, typer.Option(help="Where to write; movements.pl of the domain, and prices on the screen.")
    ] = None,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Learn which movement it is from qualitative relations, judged by leaving one trial out.

    With --noise and --period each trial is seen through a sensor of each; with --timed through four noises at three
    rates. The accuracy is told by sensor, also where it was left out of what was learned from.

    With --trace: from recordings of your own, a world state a line with what was done under "movement" (and perhaps
    "trial" and "level", the sensor); or tables with the columns t, name, x, y, heading, holding and movement.

    With --plans: what it costs to begin, give up, add and skip, from recorded days. A file holds a day, one JSON object
    a line: {"action": "eat(biscuits, plate)", "t": 3.5, "agent": "human", "goal": "breakfast"}, all but the action as
    far as it is known; the goal of an action that serves none is null.
    """
    if plans:
        _train_prices(domain, plans, output, quiet, as_json)
        return
    from casper.cli.terminal.extras import needs
    from casper.engine.domain.domain import Domain

    needs("sklearn", "train")
    if not trace:
        needs("mujoco", "sim")
    from casper.engine.actions.durations import durations_text
    from casper.engine.movements.clauses import compile_tree
    from casper.engine.movements.features import Features, TimedFeatures
    from casper.engine.movements.labelled import read_labelled
    from casper.engine.movements.tree import check_learning, fit, leave_one_trial_out
    from casper.engine.movements.watching import lasting, samples_of
    from casper.kb.text.files import unwritable

    loaded = Domain.load(domain)
    file = output or loaded.folder / "movements.pl"
    if (reason := unwritable(file)) is not None:
        raise _unwritten(file, reason)
    kind = TimedFeatures if timed else Features
    leaves = leaves or (64 if timed else 5)
    check_learning(leaves, seed, kind)
    _check_own(loaded, file)
    if trace:
        recordings = read_labelled(trace, loaded.partner)
    else:
        recordings = _of_trials(loaded, trials, seed, timed, noise or (), period or (), quiet)
    samples = list(samples_of(recordings, loaded.kb.rows, loaded.partner, kind))
    evaluation = leave_one_trial_out(samples, leaves, seed)
    text = compile_tree(fit(samples, leaves, seed), evaluation)
    if timed:
        text += "\n" + durations_text(lasting(recordings))
    try:
        file.write_text(text, encoding="utf-8")
    except OSError as mistake:
        raise _unwritten(file, mistake.strerror or str(mistake)) from None
    _tell(evaluation, len(samples), file, as_json)


def _of_trials(
    domain: Domain,
    trials: int,
    seed: int,
    timed: bool,
    noise: Sequence[float],
    period: Sequence[float],
    quiet: bool,
) -> list[Recording]:
    """Simulated trials, seen through one sensor or many."""
    from casper.cli.terminal.progress import progress
    from casper.sim_adapter.training import samples as training

    eyes: Sequence[training.Eye] = training.MANY if timed else (training.OWN,)
    if noise or period:
        eyes = [training.Eye(n, p) for n in noise or (None,) for p in period or (None,)]
    found: list[Recording] = []
    with progress("trials", trials, quiet) as at:
        for recorded in training.training_recordings(domain, trials, seed, eyes=eyes, uses=timed):
            found += recorded
            at(recorded[0].trial)
    return found


def _tell(evaluation: Evaluation, samples: int, file: Path, as_json: bool) -> None:
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.showing import say, show

    trials = len(evaluation.per_trial)
    if as_json:
        print_json(
            {
                "samples": samples,
                "trials": trials,
                "accuracy": evaluation.accuracy,
                "per_trial": {str(trial): share for trial, share in evaluation.per_trial.items()},
                "per_level": dict(evaluation.per_level),
                "unseen_level": dict(evaluation.unseen),
                "labels": list(evaluation.labels),
                "confusion": {true: dict(row) for true, row in evaluation.confusion.items()},
                "file": str(file),
            }
        )
        return
    out = console()
    say(out, f"{samples} samples from {trials} trials")
    show(out, evaluation.lines())
    say(out, f"written to {file}")


def _check_own(domain: Domain, file: Path) -> None:
    """See that what is learned will be the domain's only movements.

    Raises:
        DomainError: it takes over others elsewhere than in the file that is written, with the place of the line.
    """
    from casper.engine.domain.domain import SHIPPED
    from casper.engine.movements.leaves import MOVEMENTS
    from casper.kb.errors import DomainError
    from casper.kb.terms.clauses import Clause
    from casper.kb.text.sources import Sources

    written = domain.folder / file.name
    taken = [clause for of in MOVEMENTS for clause in domain.kb.clauses_of(of)]
    if file.parent.resolve() != domain.folder.resolve() or not taken:
        return
    own = Sources((SHIPPED,)).sentences(written) if written.is_file() else []
    if not any(isinstance(sentence, Clause) and sentence.head.indicator in MOVEMENTS for sentence in own):
        place = taken[0].place
        advice = 'include household/actions.pl instead of household.pl, and write :- include("household/movements.pl").'
        raise DomainError(f"the movements are taken over from {place.file}: {advice} into movements.pl first")


def _train_prices(domain: str, files: list[Path], output: Path | None, quiet: bool, as_json: bool) -> None:
    from dataclasses import asdict

    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.progress import progress
    from casper.cli.terminal.showing import say
    from casper.engine.domain.domain import Domain
    from casper.engine.episodes.training import learn, read_day

    loaded = Domain.load(domain)
    with progress("reading the days", None, quiet):
        learned = learn(lambda prices: loaded.day(**asdict(prices)), [read_day(file) for file in files], loaded.prices)
    if output is not None:
        try:
            output.write_text(learned.to_text(), encoding="utf-8")
        except OSError as mistake:
            raise _unwritten(output, mistake.strerror or str(mistake)) from None
    if as_json:
        told = {"days": learned.days, "observations": learned.observations, "episodes": learned.episodes}
        print_json({**asdict(learned.prices), **told, "file": None if output is None else str(output)})
        return
    out = console()
    say(out, f"% from {learned.observations} observations of {learned.episodes} episodes; for plans.pl")
    say(out, learned.to_text().rstrip())
    if output is not None:
        say(out, f"% written to {output}")


def _unwritten(file: Path, reason: str) -> CasperError:
    from casper.kb.errors import DomainError

    return DomainError(f"cannot write {file} ({reason}); choose another place with --output")
