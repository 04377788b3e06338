"""What is asked of a knowledge base again and again, remembered for as long as it stays as it is."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from typing import Any, TypeVar

from casper.kb.base import KnowledgeBase

MOST = 10_000
T = TypeVar("T")


class Remembered:
    """Answers by their questions. Several threads may ask: what they work out twice is the same.

    Args:
        kb: what is asked.
        most: how many answers are kept; then all are forgotten.
    """

    def __init__(self, kb: KnowledgeBase, most: int = MOST) -> None:
        self._kb, self._most = kb, most
        self._answers: tuple[int, dict[Hashable, tuple[Any, Any]]] = (kb.changes, {})  # of that state of the base

    def of(self, question: Hashable, work: Callable[[], T], about: object = None) -> T:
        """What the work gives, or gave before.

        Args:
            question: tells it from all others.
            work: finds the answer, of the knowledge base as it is and of what is in the question.
            about: something that the question names by its `id`; it is kept, so that nothing else gets that.
        """
        changes, answers = self._answers
        if changes != self._kb.changes or len(answers) >= self._most:
            changes, answers = self._answers = (self._kb.changes, {})
        found = answers.get(question)
        if found is None:
            found = work(), about
            if changes == self._kb.changes:  # it may have changed under way
                answers[question] = found
        answer: T = found[0]
        return answer
