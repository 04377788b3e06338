"""Goals, statements and steps in an author's words, for events and readings, which name them by their texts."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

from casper.engine.events.phrases import PHRASES
from casper.kb.errors import CasperError
from casper.kb.reasons.phrases import phrased
from casper.kb.reasons.says import SILENT, Words
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Term, as_term
from casper.kb.text.reader import read_statement


@dataclass(frozen=True)
class Telling:
    """What is told in words, and who the partner is."""

    words: Words = SILENT
    partner: str = "the partner"

    @property
    def is_used(self) -> bool:
        """Whether anything is told in other words than the system's."""
        return bool(self.words) or self.words.is_foreign

    def phrase(self, name: str, *values: object) -> str:
        """What the mind says around sentences."""
        return phrased(PHRASES, self.words.language, name, *values)

    def name(self, text: str) -> str:
        """How an agent or a thing is called."""
        return self.words.text(text) if self.words else text

    def thing(self, value: Term) -> str:
        """How a value is called."""
        return self.words.text(value)

    def statement(self, text: str) -> str:
        """A statement, agent included, in words; as it is where nobody worded it."""
        atom = _atom(text) if self.words else None
        return text if atom is None else self.words.sentence(atom) or text

    def denied(self, text: str) -> str | None:
        """That a statement cannot be, where its author says that."""
        atom = _atom(text) if self.words else None
        return None if atom is None else self.words.sentence(atom, denied=True, plainly=True)

    def step(self, text: str, agent: str | None = None) -> str:
        """An action that leaves its agent out: as the statement of its agent, or worded as such (None: by anybody)."""
        atom = _atom(text) if self.words else None
        if atom is None:
            return text
        whole = None if agent is None else self.words.sentence(Compound((atom.functor, agent, *atom.args)))
        return whole or self.words.sentence(atom) or text

    def theirs(self, text: str) -> str:
        """A step of the partner."""
        return self.step(text, self.partner)

    def goal(self, label: str) -> str:
        """A goal, or several at once, in words; by its name where its label has no arguments."""
        return " + ".join(map(self._goal, label.split(" + "))) if self.words else label

    def _goal(self, label: str) -> str:
        atom = _atom(label)
        if atom is None:
            return label
        said = self.words.sentence(atom)
        return said or (self.words.named(label) if len(atom) == 1 else None) or label


PLAIN = Telling()
"""Everything is told as the terms it is."""


def will_do(tell: Telling, agent: str, goal: str, actions: Sequence[Compound]) -> str:
    """What an agent says before it does its part of a goal: what it will do, and why."""
    steps = tell.phrase("then").join(tell.step(term_text(as_term(action)), agent) for action in actions)
    why = tell.phrase("goal", tell.goal(goal))
    return sentence(tell.phrase("now" if tell.is_used else "will now", tell.name(agent), steps, why))


def sentence(text: str) -> str:
    """With a full stop, and a capital where it begins with a word."""
    return f"{text[:1].upper()}{text[1:]}."


@lru_cache(maxsize=4096)
def _atom(text: str) -> Compound | None:
    """The statement that a text is; None where it is none."""
    try:
        return read_statement(text)
    except CasperError:
        return None
