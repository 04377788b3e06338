"""Exit codes: all there are, in one table, which the help and docs/commands.md show."""

from __future__ import annotations

from textwrap import wrap

CODES: dict[int, str] = {
    0: "done; the answer is yes",
    1: "the answer is no: a statement is not valid (verify), nothing answers (query), a domain has errors (check), "
    "an import contradicts itself (import), a row has a mistake (batch), "
    "something is broken (doctor), a connection was lost (watch), a replay is not the same (replay)",
    2: "a mistake, told in one sentence on standard error: an argument, a file, a missing library",
    130: "interrupted from the keyboard",
}


def epilog() -> str:
    """The table as a text below the commands; the mark in front keeps its lines as they are."""
    rows = (wrap(meaning, 64) for meaning in CODES.values())
    lines = [f"{code:>5}  " + f"\n{' ' * 7}".join(row) for code, row in zip(CODES, rows)]
    return "\b\nExit codes:\n" + "\n".join(lines)
