"""What may have happened, weighed: statements with their chances, judged, become one observation that is not sure."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from dataclasses import dataclass
from math import fsum

from casper.engine.verification.observation import Observation, Seen, Uncertain
from casper.engine.verification.verification import Statement, Verifier
from casper.kb.reasons.validity import Verdict

NEGLIGIBLE = 0.02  # share of an option that is not followed up
SURE = 0.98  # share from which an option is the only one


@dataclass(frozen=True, slots=True)
class Judged:
    """``statement`` is the likeliest that is valid, or that is none where ``seen`` is None; its verdict, if asked."""

    statement: Statement
    verdict: Verdict | None
    seen: Seen | None


def judged(stated: Mapping[Statement, float], verifier: Verifier | None, known: Collection[str]) -> Judged:
    """The valid ones of some statements, as an observation.

    Args:
        stated: their chances, at least one.
        verifier: what judges them; None takes all for valid, by name.
        known: the plans' actions; what is none of them is told only when nothing else is valid.
    """
    options: dict[Observation, float] = {}
    best: tuple[float, Statement, Verdict | None] | None = None
    least = NEGLIGIBLE * fsum(stated.values())
    verdicts = {s: None if verifier is None else verifier.judge(s) for s, chance in stated.items() if chance > least}
    for statement, verdict in verdicts.items():
        if verdict is not None and not verdict.valid:
            continue
        share = stated[statement] * (statement.action in known or NEGLIGIBLE)
        option = _observation(statement, verdict)
        options[option] = options.get(option, 0.0) + share
        if best is None or share > best[0]:
            best = share, statement, verdict
    if best is None:
        first = max(stated, key=stated.__getitem__)
        return Judged(first, verdicts.get(first), None)
    return Judged(best[1], best[2], _weighed(options))


def _observation(statement: Statement, verdict: Verdict | None) -> Observation:
    if verdict is None:
        return Observation(statement.action, t=statement.t)
    return Observation(verdict.completed.functor, verdict.completed.args[1:], statement.t)


def _weighed(options: Mapping[Observation, float]) -> Seen:
    total = fsum(options.values())
    shares = {option: share / total for option, share in options.items() if share > NEGLIGIBLE * total}
    best = max(shares, key=shares.__getitem__)
    return best if shares[best] >= SURE * fsum(shares.values()) else Uncertain(tuple(shares.items()))
