"""``casper train``: learn the movements from simulated trials and write them as clauses."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from casper.cli.terminal.options import AsJson, DomainName, Quiet

if TYPE_CHECKING:
    from casper.engine.domain.domain import Domain
    from casper.engine.movements.tree import Evaluation
    from casper.kb.errors import CasperError


def train(
    domain: DomainName,
    trials: Annotated[int, typer.Option(min=2, max=1000, help="Scripted trials to learn from.")] = 10,
    seed: Annotated[int, typer.Option(help="Of the trials and the tree; the same seed gives the same file.")] = 1,
    leaves: Annotated[int, typer.Option(min=2, help="Leaves the tree may have.")] = 5,
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

    With --plans: what it costs to begin, give up, add and skip, from recorded days. A file holds a day, one JSON object
    a line: {"action": "eat(biscuits, plate)", "t": 3.5, "agent": "human", "goal": "breakfast"}, all but the action as
    far as it is known; the goal of an action that serves none is null.
    """
    if plans:
        _train_prices(domain, plans, output, quiet, as_json)
        return
    from casper.cli.terminal.extras import needs
    from casper.cli.terminal.output import print_json
    from casper.cli.terminal.progress import progress
    from casper.engine.domain.domain import Domain

    needs("sklearn", "train")
    needs("mujoco", "sim")
    from casper.engine.movements.clauses import compile_tree
    from casper.engine.movements.tree import check_learning, fit, leave_one_trial_out
    from casper.kb.text.files import unwritable
    from casper.sim_adapter.training.samples import training_samples

    loaded = Domain.load(domain)
    file = output or loaded.folder / "movements.pl"
    if (reason := unwritable(file)) is not None:
        raise _unwritten(file, reason)
    check_learning(leaves, seed)
    _check_own(loaded, file)
    samples = []
    with progress("trials", trials, quiet) as at:
        for sample in training_samples(loaded, trials, seed):
            samples.append(sample)
            at(sample.trial)
    evaluation = leave_one_trial_out(samples, leaves, seed)
    try:
        file.write_text(compile_tree(fit(samples, leaves, seed), evaluation), encoding="utf-8")
    except OSError as mistake:
        raise _unwritten(file, mistake.strerror or str(mistake)) from None
    if as_json:
        print_json(
            {
                "samples": len(samples),
                "trials": trials,
                "accuracy": evaluation.accuracy,
                "per_trial": {str(trial): share for trial, share in evaluation.per_trial.items()},
                "labels": list(evaluation.labels),
                "confusion": {true: dict(row) for true, row in evaluation.confusion.items()},
                "file": str(file),
            }
        )
    else:
        _show(evaluation, len(samples), trials, file)


def _check_own(domain: Domain, file: Path) -> None:
    """See that what is learned will be the domain's only movements.

    Raises:
        DomainError: it takes over others elsewhere than in the file that is written, with the place of the line.
    """
    from casper.engine.domain.domain import SHIPPED
    from casper.kb.errors import DomainError
    from casper.kb.terms.clauses import Clause
    from casper.kb.text.sources import Sources

    written = domain.folder / file.name
    if file.parent.resolve() != domain.folder.resolve() or not domain.kb.clauses_of(("movement", 5)):
        return
    own = Sources((SHIPPED,)).sentences(written) if written.is_file() else []
    if not any(isinstance(sentence, Clause) and sentence.head.indicator == ("movement", 5) for sentence in own):
        place = domain.kb.clauses_of(("movement", 5))[0].place
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


def _show(evaluation: Evaluation, samples: int, trials: int, file: Path) -> None:
    from casper.cli.terminal.output import console
    from casper.cli.terminal.showing import say, show

    out = console()
    say(out, f"{samples} samples from {trials} trials")
    show(out, evaluation.lines())
    say(out, f"written to {file}")
