"""Hot reload: a domain whose files have changed is read anew, and what was observed stays observed.

    >>> domain = reloaded(domain)                        # the same object as long as no file has changed
    >>> reading, dropped = carried_over(reading, domain)  # observations that fit no more come back with the reason

A mistake in a changed file raises, with its place, and whoever holds the old domain goes on with it. `engine.live` does
the same for a running mind.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from casper.engine.domain.domain import FILES, Domain
from casper.engine.reading.reading import Reading
from casper.engine.recognition.scoring import name_of
from casper.engine.verification.observation import Seen
from casper.kb.errors import CasperError
from casper.kb.text.sources import fingerprint


@dataclass(frozen=True, slots=True)
class Dropped:
    """Something observed that the changed domain has no place for."""

    observed: str
    reasons: tuple[str, ...]

    def __str__(self) -> str:
        return f"{self.observed} fits no more: {'; '.join(self.reasons)}"


def reloaded(domain: Domain) -> Domain:
    """The domain as its files are now; the very same object when nothing has changed, or when it came from no files.

    Raises:
        CasperError: a mistake in a changed file, with its place; the old domain is as good as before.
    """
    if not domain.fingerprint or current_fingerprint(domain) == domain.fingerprint:
        return domain
    return Domain.load(domain.folder, domain.kb.language)


def current_fingerprint(domain: Domain) -> str:
    """What tells the files of a domain as they are now from how they were."""
    return fingerprint([*(domain.folder / file for file in FILES), *domain.files])


def carried_over(
    reading: Reading, domain: Domain, policy: str = "strict", verification: bool = True
) -> tuple[Reading, tuple[Dropped, ...]]:
    """A reading of the domain with the observations and options of another one, and what of them fits no more.

    Args:
        reading: where the observations come from; it stays as it is.
        domain: what they are read with now.
        policy, verification: as for `Domain.reading`.
    """
    chosen = reading.options
    score = name_of(chosen.measure)
    fresh = domain.reading(policy, verification, chosen.noise, chosen.goals, score, chosen.budget)
    return fresh, tuple(replayed(reading.observations, fresh))


def replayed(observations: Sequence[Seen], fresh: Reading) -> list[Dropped]:
    """Take the observations in as far as they fit; those that do not."""
    dropped = []
    for observation in observations:
        try:
            fresh.observe(observation)
        except CasperError as mistake:
            dropped.append(Dropped(str(observation), (mistake.sentence,)))
            continue
        if fresh.count == 0:
            reasons = tuple(f"{goal}: {', '.join(why)}" for goal, why in fresh.rejected.items())
            fresh.undo()
            dropped.append(Dropped(str(observation), reasons))
    return dropped
