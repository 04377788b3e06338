"""A reading: what the partner's actions so far say about their goal, and why.

>>> reading = Domain.load("kitchen").reading()
>>> reading.observe("pick_and_place(meal, hobs)")
>>> reading.outcome, reading.confidence
('lunch', 1.0)
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import replace
from functools import cached_property
from typing import Any

from casper.engine.collaboration.collaboration import Capability
from casper.engine.events.telling import PLAIN, Telling
from casper.engine.explanation.situation import Situation
from casper.engine.reading.explained import Explained
from casper.engine.reading.policy import Policy, strict
from casper.engine.reading.printing import reading_lines, reading_name
from casper.engine.recognition.choice import recogniser
from casper.engine.recognition.options import PAPER, Options
from casper.engine.verification.matching import NOBODY, Agents, Matcher, NameMatcher, Recipe
from casper.engine.verification.observation import Observed, Seen, at_time, seen_of
from casper.engine.verification.vocabulary import Foreign, Vocabulary
from casper.kb.errors import CasperError
from casper.kb.reasons.says import SILENT, Words
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.lines import Line, Shown, text_of
from casper.plans.library import PlanLibrary

WEIGHABLE = 300  # observations up to which there are not too many explanations to be weighed
MOST_BITS = 1000  # of a count that floats can weigh


def nobody_can(situation: Situation, leaf: int, agent: str) -> tuple[Compound, bool]:
    """The capability of those of whom nothing is known."""
    return situation.leaves[leaf], False


class Reading(Explained, Shown):
    """Explanations of a growing list of observations.

    Args:
        library: the plans.
        matcher: what can be taken for what (`engine.verification.matching`); verification lives there.
        policy: when to commit to a goal.
        capability: what an agent can do of a plan's leaves; by default nobody can do anything.
        options: noise, several goals, priors, other scores; everything is off by default.

    Raises:
        CasperError: options that make no sense.
    """

    def __init__(
        self,
        library: PlanLibrary,
        matcher: Matcher,
        policy: Policy = strict,
        capability: Capability = nobody_can,
        options: Options = PAPER,
    ) -> None:
        self.library, self.policy, self.options = library, policy, options
        self._actions = list(library.actions)
        self._capability = capability
        self._unused = matcher.fork()  # as it was before anything was observed
        self._engine = recogniser(library.ways, matcher, options)
        self._read: dict[str, Seen] = {}  # texts that were observed before
        self._numbers: dict[str, list[int]] = {}  # each goal's plans
        for number, plan in enumerate(library.ways):
            self._numbers.setdefault(plan.label, []).append(number)
        self._rejected: list[dict[str, tuple[str, ...]]] = []  # after each observation, as far as anybody asked

    # --- observing -------------------------------------------------------------------------------------------------

    def observe(self, observed: Observed, t: float | None = None) -> None:
        """Take in one action of the partner: ``"eat"`` or ``"eat(biscuits, plate)"``.

        ``t`` is when it was seen (seconds), for rules that ask did/2 how long ago something was. Without it only the
        order is known, and what such rules say is unknown, which rules nothing out.

        What was not made out for sure is a mapping of what it may be to likelihoods: ``{"eat": 0.7, "sip": 0.2}``.
        An observation that fits no plan leaves zero explanations; `undo` goes back to where the reading was. One that
        no plan has is needless, where needless ones have a price (`unknown`).

        Raises:
            ReadError, PlanError: the text is no action, or no plan has it and needless actions have no price.
            CasperError: likelihoods that are none, or more explanations than can be weighed.
        """
        seen = at_time(self._seen(observed), t)
        self._engine.observe(seen)
        if len(self._engine.observations) > WEIGHABLE and self._engine.count.bit_length() > MOST_BITS:
            self._engine.undo()
            raise CasperError(f"after {seen} there are more explanations than can be weighed, over 10^300")

    def _seen(self, observed: Observed) -> Seen:
        if not isinstance(observed, str):
            return self._seen_of(observed)
        seen = self._read.get(observed)
        if seen is None:
            seen = self._read[observed] = self._seen_of(observed)
        return seen

    def _seen_of(self, observed: Observed) -> Seen:
        return seen_of(observed, self._actions) if self.options.noise is None else self._vocabulary.read(observed)

    @cached_property
    def _vocabulary(self) -> Vocabulary:
        leaves = [leaf for plan in self.library.ways for leaf in plan.leaves]
        return Vocabulary(dict.fromkeys(leaves), isinstance(self._unused, NameMatcher))

    words: Words = SILENT  # in which steps and questions are told

    @property
    def tell(self) -> Telling:
        """What tells goals and steps in the author's words."""
        return Telling(self.words, self.agents.partner or PLAIN.partner)

    def fork(self) -> Reading:
        """A reading that goes its own way from here: "what if the next is …". What was counted so far is shared."""
        other = object.__new__(type(self))
        other.__dict__.update(self.__dict__)
        other._engine, other._rejected = self._engine.fork(), list(self._rejected)
        return other

    def __reduce__(self) -> tuple[Any, ...]:
        """By what it was made of and what was observed, which is observed again where it arrives.

        So it says what the knowledge base says there and then; what was counted is never sent.
        """
        recipe: Recipe | Matcher = getattr(self._unused, "recipe", self._unused)
        return _resumed, (
            self.library,
            recipe,
            self.policy,
            self._capability,
            self.options,
            self.observations,
            self.words,
        )

    def reread(self, noise: float) -> Reading:
        """The same, read anew with a price on needless and misread actions (`Options.noise`).

        Raises:
            CasperError: a price that is none.
        """
        make, parts = self.__reduce__()
        read: Reading = make(*(replace(part, noise=noise) if isinstance(part, Options) else part for part in parts))
        return read

    def undo(self) -> None:
        """Take back the last observation.

        Raises:
            CasperError: there is none.
        """
        if not self._engine.observations:
            raise CasperError("there is no observation to take back")
        self._engine.undo()
        del self._rejected[len(self._engine.observations) + 1 :]

    @property
    def unknown(self) -> dict[int, Foreign]:
        """By the number of an observation, from 0, that no plan has: why, and the nearest action of the plans.

        Empty where needless actions have no price: such an observation is refused then.
        """
        if self.options.noise is None:
            return {}
        found = {at: self._vocabulary.foreign(seen) for at, seen in enumerate(self.observations)}
        return {at: foreign for at, foreign in found.items() if foreign is not None}

    @property
    def agents(self) -> Agents:
        """Who is watched, and who helps, as far as the matcher knows."""
        found = getattr(self._unused, "agents", NOBODY)
        return found if isinstance(found, Agents) else NOBODY

    @property
    def capability(self) -> Capability:
        """What an agent can do of a plan's leaves."""
        return self._capability

    # --- shown -----------------------------------------------------------------------------------------------------

    def to_json(self, top: int = 3) -> dict[str, Any]:
        """The design's object for ``casper explain --json``."""
        best = self.best(max(top, 1))
        bound: dict[str, Any] = {} if self.is_exact else {"exact": False}
        return {
            "observations": [str(observation) for observation in self.observations],
            "explanations": self.count,
            "confidence": best[0].share if best else 0.0,
            "outcome": self.outcome,
            "posterior": dict(self.posterior),
            "best": [explanation.to_json() for explanation in best[:top]],
            "frontier": [term_text(as_term(action)) for action in (best[0].frontier if best else ())],
            "rejected": [{"goal": goal, "reasons": list(reasons)} for goal, reasons in self.rejected.items()],
            **bound,
            **self._unknown_json(),
        }

    def _unknown_json(self) -> dict[str, Any]:
        told = [
            {"observation": at + 1, "reasons": list(foreign.reasons), "nearest": foreign.nearest}
            for at, foreign in self.unknown.items()
        ]
        return {"unknown": told} if told else {}

    def lines(self, top: int = 3, asked: int = 0) -> Iterator[Line]:
        """What a person is shown, with the best ``top`` explanations and as many questions as are ``asked`` for."""
        return reading_lines(self, top, asked)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return reading_name(self)


def _resumed(
    library: PlanLibrary,
    recipe: Recipe | Matcher,
    policy: Policy,
    capability: Capability,
    options: Options,
    observations: Sequence[Seen],
    words: Words,
) -> Reading:
    """A reading in which everything is observed again."""
    matcher = recipe[0](library.ways, *recipe[1:]) if isinstance(recipe, tuple) else recipe
    reading = Reading(library, matcher, policy, capability, options)
    reading.words = words
    for seen in observations:
        reading.observe(seen)
    return reading
