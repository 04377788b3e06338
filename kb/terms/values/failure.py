"""What is raised where an expression has no value."""

from __future__ import annotations


class EvaluationFailed(Exception):
    """A ground expression that has no value; ``sentence`` says why, with the expression."""

    def __init__(self, sentence: str) -> None:
        super().__init__(sentence)
        self.sentence = sentence
