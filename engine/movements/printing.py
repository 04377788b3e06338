"""How the evaluation of a movement tree is shown to a person: its accuracy and what was taken for what."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from casper.kb.text.lines import Line, Role, Span, line


def evaluation_lines(
    accuracy: float, labels: Sequence[str], confusion: Mapping[str, Mapping[str, int]]
) -> Iterator[Line]:
    """The share of samples right, and a table: a row a true movement, a column what it was taken for."""
    yield line("leave-one-trial-out accuracy ", Span(f"{accuracy:.3f}", "strong"))
    rows = [[true, *(str(confusion[true][seen] or "·") for seen in labels)] for true in labels]
    table = [["true \\ taken for", *labels], *rows]
    widths = [max(map(len, column)) for column in zip(*table)]
    for number, row in enumerate(table):
        role: Role = "plain" if number else "faint"
        yield line(Span("".join(f" {cell:<{width}} " for cell, width in zip(row, widths)), role))


def level_lines(per_level: Mapping[str, float], unseen: Mapping[str, float]) -> Iterator[Line]:
    """The share right by sensor, and where it was left out of what was learned from."""
    if not per_level:
        return
    width = max(map(len, per_level))
    yield line(Span(f" {'sensor':<{width}}  accuracy  learned without it", "faint"))
    for level, share in per_level.items():
        alone = f"{unseen[level]:8.3f}" if level in unseen else f"{'unknown':>8}"
        yield line(f" {level:<{width}}  {share:8.3f}  {alone}")
