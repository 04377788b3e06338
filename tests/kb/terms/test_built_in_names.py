"""The built-in predicates are those that the page of the language has on its table, each with its arguments."""

import re
from pathlib import Path

from casper.kb.terms.builtins import BUILTINS, MOST_EXTRA

PAGE = Path(__file__).resolve().parents[3] / "docs/language.md"


def test_the_page_has_every_built_in_and_no_other():
    table = PAGE.read_text(encoding="utf-8").split("## Built-in predicates")[1].split("One that cannot be decided")[0]
    rows = [line.split("|")[1] for line in table.splitlines() if line.startswith("| `")]
    written = [found for row in rows for found in re.findall(r"`([a-z_0-9]+)(?:\(([^`]*)\))?`", row)]
    named = {(name, args.count(",") + 1 if args else 0) for name, args in written if "…" not in args}
    assert named | {("call", 1 + extra) for extra in range(1, MOST_EXTRA + 1)} | {("false", 0)} == BUILTINS
