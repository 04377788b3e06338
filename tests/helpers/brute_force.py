"""The shipped oracle of explanations, by the name that the tests use."""

from casper.testing.oracles.explanations import Told, explanations, markings, of_plan, rows

__all__ = ["Told", "explanations", "markings", "of_plan", "rows"]
