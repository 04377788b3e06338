"""Questions: what to find out to be surer of the goal, by the bits an answer takes from the uncertainty about it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from math import log2
from typing import Any, Literal, TypeAlias

from casper.engine.events.telling import Telling
from casper.engine.reading.outlook import Outlook, shown
from casper.engine.verification.binding import Binding

End: TypeAlias = tuple[int, int, Binding]  # plan, mask of closed leaves, binding
Kind: TypeAlias = Literal["goal", "done", "step", "next"]
ASKED = {"goal": "is the goal {}?", "done": "was {} done?", "step": "will {} still be done?", "next": "is {} next?"}


@dataclass(frozen=True, slots=True)
class Question:
    """Something to find out: ``gain`` is how many bits of the uncertainty about the goal the answer takes on average.

    ``kind`` is ``goal`` (is it this goal?), ``done`` (was this action done, seen or unseen?), ``step`` (is it still to
    be done?) or ``next`` (is it the next one? it may be asked, or simply be watched for). ``yes`` is the probability of
    that answer.
    """

    kind: Kind
    about: str
    yes: float
    gain: float
    told: str = field(default="", compare=False, repr=False)  # in the author's words, where there are any

    def __str__(self) -> str:
        return self.told or ASKED[self.kind].format(self.about)

    def to_json(self) -> dict[str, Any]:
        """``{"question", "kind", "about", "yes", "gain"}``."""
        return {"question": str(self), "kind": self.kind, "about": self.about, "yes": self.yes, "gain": self.gain}


_ASKED_IN_WORDS = {"goal": "is goal", "done": "was done", "step": "will be done", "next": "is next"}


def in_words(question: Question, tell: Telling) -> Question:
    """The question with what it is about told by its author; the same where nobody worded that."""
    said = tell.goal(question.about) if question.kind == "goal" else tell.step(question.about)
    if said == question.about and not tell.words.is_foreign:
        return question
    return replace(question, told=tell.phrase(_ASKED_IN_WORDS[question.kind], said))


def questions(outlook: Outlook) -> list[Question]:
    """What to find out, most telling first: about goals, steps done or still to come, and the next action.

    Nothing is asked of which the explanations do not know the answer: of steps that may be left out.
    """
    goals: dict[str, float] = {}
    unsure: set[tuple[Kind, str]] = set()
    told: dict[tuple[Kind, str], dict[str, float]] = {}  # by question: the share of yes, by goal
    for parts, share in outlook.engine.ends():
        pursued = " + ".join(outlook.plans[part[0]].label for part in parts)
        goals[pursued] = goals.get(pursued, 0.0) + share
        for question, part_of_it in _answered(outlook, parts).items():
            by_goal = told.setdefault(question, {})
            by_goal[pursued] = by_goal.get(pursued, 0.0) + share * part_of_it
        for part in parts:
            unsure.update(("done" if over else "step", shown(action)) for over, action in outlook.unsure(*part))
    return ranked(goals, {question: yes for question, yes in told.items() if question not in unsure})


def ranked(goals: Mapping[str, float], told: Mapping[tuple[Kind, str], Mapping[str, float]]) -> list[Question]:
    """Questions, most telling first.

    Args:
        goals: the share of each goal.
        told: by question the share of yes, by goal.
    """
    before = _Uncertainty(goals)
    found = [before.asked(*question, yes) for question, yes in told.items()]
    order = {"goal": 0, "done": 1, "step": 2, "next": 3}
    return sorted(found, key=lambda q: (-round(q.gain, 12), order[q.kind], q.about))


def _answered(outlook: Outlook, parts: Iterable[End]) -> dict[tuple[Kind, str], float]:
    """What explanations that end here say yes to; where the order is open, in part."""
    answers: dict[tuple[Kind, str], float] = {}
    following: list[str] = []
    for part in parts:
        answers.update((("step", shown(action)), 1.0) for action in outlook.frontier(*part))
        answers.update((("done", shown(action)), 1.0) for action in outlook.done(*part))
        answers["goal", outlook.plans[part[0]].label] = 1.0
        following += map(shown, outlook.next(*part))
    for action in following:
        answers["next", action] = answers.get(("next", action), 0.0) + 1 / len(following)
    return answers


class _Uncertainty:
    """The entropy of the goal, and what an answer leaves of it: only the goals that say yes are looked at."""

    def __init__(self, goals: Mapping[str, float]) -> None:
        self.goals, self.whole = goals, sum(goals.values())
        self.terms = sum(map(_term, goals.values()))

    def asked(self, kind: Kind, about: str, yes: Mapping[str, float]) -> Question:
        """The question with the bits it takes on average; ``yes`` is the share of that answer by goal."""
        positive, terms = sum(yes.values()), sum(map(_term, yes.values()))
        left = self.terms
        for goal, share in yes.items():
            left += _term(max(self.goals[goal] - share, 0.0)) - _term(self.goals[goal])
        negative = max(self.whole - positive, 0.0)
        after = _bits(positive, terms) + _bits(negative, left)
        gain = (_bits(self.whole, self.terms) - after) / self.whole if self.whole else 0.0
        return Question(kind, about, positive / self.whole if self.whole else 0.0, max(gain, 0.0))


def _term(share: float) -> float:
    return share * log2(share) if share > 0 else 0.0


def _bits(whole: float, terms: float) -> float:
    """The entropy of shares in bits, times their sum; ``terms`` is the sum of x log x."""
    return whole * log2(whole) - terms if whole > 0 else 0.0


def entropy(shares: Iterable[float]) -> float:
    """The entropy of a distribution in bits; it need not be normalised."""
    known = list(shares)
    whole = sum(known)
    return _bits(whole, sum(map(_term, known))) / whole if whole else 0.0
