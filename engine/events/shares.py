"""What was observed, and the goals with their shares, as readings, days and timelines show them."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass

from casper.kb.text.lines import Line, Span, bar, line

MOST_GOALS = 30  # shown with their shares
WIDTH = 80  # of the rule behind what was observed
NARROWEST = 13  # column of goals, where each is a line of its own


@dataclass(frozen=True, slots=True)
class Shares:
    """The goals that are shown with their shares, how wide their column is, and how many goals there are besides."""

    shown: tuple[tuple[str, float], ...]
    width: int
    left_out: int

    def rest(self) -> Iterator[Line]:
        """A line about the goals that are not shown, if there are any."""
        if self.left_out:
            yield line(Span(f"  … and {self.left_out} goals that are no likelier", "faint"))


def shares_table(posterior: Mapping[str, float], narrowest: int = 12) -> Shares:
    """All goals in their order; of more than `MOST_GOALS` the likeliest, most likely first.

    ``narrowest`` is the least width of the column of goals, with the space behind.
    """
    shown = list(posterior.items())
    if len(shown) > MOST_GOALS:
        shown = sorted(shown, key=lambda pair: -pair[1])[:MOST_GOALS]
    width = max([narrowest, *(len(name) + 1 for name, _ in shown)])
    return Shares(tuple(shown), width, len(posterior) - len(shown))


def heading(observations: Sequence[object]) -> Line:
    """What was observed, in order, and a rule behind it."""
    shown = " → ".join(map(str, observations)) or "nothing observed"
    rule = "─" * (WIDTH - 1 - len(shown))
    return line(Span(shown, "strong"), Span(f" {rule}" if rule else "", "faint"))


def shares_lines(posterior: Mapping[str, float], against: Mapping[str, Sequence[str]]) -> Iterator[Line]:
    """A line for each goal: its share as a bar and a number, and the reasons against it."""
    table = shares_table(posterior, NARROWEST)
    for goal, share in table.shown:
        reasons = "; ".join(against.get(goal, ()))
        note = [Span(f"  not this: {reasons}", "faint")] if reasons else []
        yield line(f"  {goal:<{table.width}}", bar(share), f" {share:.2f}", *note)
    yield from table.rest()
