"""``casper train``: the movements, learned from trials and written as clauses of a domain."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from casper.cli.authoring.written import check_output, write_output
from casper.cli.terminal.extras import needs
from casper.cli.terminal.output import console, print_json
from casper.cli.terminal.progress import progress
from casper.cli.terminal.showing import say, show
from casper.engine.actions.durations import durations_text
from casper.engine.domain.domain import SHIPPED, Domain
from casper.engine.movements.clauses import compile_tree
from casper.engine.movements.features import Features, TimedFeatures
from casper.engine.movements.labelled import read_labelled
from casper.engine.movements.leaves import MOVEMENTS
from casper.engine.movements.tree import Evaluation, check_learning, fit, leave_one_trial_out
from casper.engine.movements.watching import Recording, lasting, samples_of
from casper.kb.errors import DomainError
from casper.kb.terms.clauses import Clause
from casper.kb.text.sources import Sources

LEAVES, TIMED_LEAVES = 5, 64


@dataclass(frozen=True, slots=True)
class Lesson:
    """What is learned from: as many simulated ``trials``, seen through sensors, or recordings (``trace``).

    seed: of the trials and the tree. leaves: that the tree may have; None: as many as is usual. timed: whether it looks
    back. noise (metres) and period (seconds): of the sensors, each with each; none: the domain's own, or, timed, many.
    """

    trials: int
    seed: int
    leaves: int | None = None
    timed: bool = False
    noise: Sequence[float] = ()
    period: Sequence[float] = ()
    trace: Sequence[Path] = ()


def learn_movements(domain: str, lesson: Lesson, output: Path | None, quiet: bool, as_json: bool) -> None:
    """Learn which movement it is, and write and tell it.

    Args:
        domain: whose movements.
        lesson: what they are learned from.
        output: where the clauses go; None: movements.pl of the domain.
        quiet, as_json: how it is told.

    Raises:
        CasperError: a library is missing, a domain or a file has a mistake, a number is none, or nothing can be
            written there.
    """
    needs("sklearn", "train")
    if not lesson.trace:
        needs("mujoco", "sim")
    loaded = Domain.load(domain)
    file = output or loaded.folder / "movements.pl"
    check_output(file)
    kind = TimedFeatures if lesson.timed else Features
    leaves = lesson.leaves or (TIMED_LEAVES if lesson.timed else LEAVES)
    check_learning(leaves, lesson.seed, kind)
    _check_own(loaded, file)
    recordings = read_labelled(lesson.trace, loaded.partner) if lesson.trace else _simulated(loaded, lesson, quiet)
    samples = list(samples_of(recordings, loaded.kb.rows, loaded.partner, kind))
    evaluation = leave_one_trial_out(samples, leaves, lesson.seed)
    text = compile_tree(fit(samples, leaves, lesson.seed), evaluation)
    if lesson.timed:
        text += "\n" + durations_text(lasting(recordings))
    write_output(text, file)
    tell(evaluation, len(samples), file, as_json)


def _simulated(domain: Domain, lesson: Lesson, quiet: bool) -> list[Recording]:
    """Simulated trials, seen through one sensor or many."""
    from casper.sim_adapter.training import samples as training

    eyes: Sequence[training.Eye] = training.MANY if lesson.timed else (training.OWN,)
    if lesson.noise or lesson.period:
        eyes = [training.Eye(n, p) for n in lesson.noise or (None,) for p in lesson.period or (None,)]
    found: list[Recording] = []
    with progress("trials", lesson.trials, quiet) as at:
        for seen in training.training_recordings(domain, lesson.trials, lesson.seed, eyes=eyes, uses=lesson.timed):
            found += seen
            at(seen[0].trial)
    return found


def tell(evaluation: Evaluation, samples: int, file: Path, as_json: bool) -> None:
    """Print how well the movements are told apart, by whether a trial or a sensor was left out, and where they went."""
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
    written = domain.folder / file.name
    taken = [clause for of in MOVEMENTS for clause in domain.kb.clauses_of(of)]
    if file.parent.resolve() != domain.folder.resolve() or not taken:
        return
    own = Sources((SHIPPED,)).sentences(written) if written.is_file() else []
    if not any(isinstance(sentence, Clause) and sentence.head.indicator in MOVEMENTS for sentence in own):
        place = taken[0].place
        advice = 'include household/actions.pl instead of household.pl, and write :- include("household/movements.pl").'
        raise DomainError(f"the movements are taken over from {place.file}: {advice} into movements.pl first")
