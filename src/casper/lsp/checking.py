"""The process that runs the whole check for the language server (`lsp.whole`): lines of JSON in, lines of JSON out."""

from __future__ import annotations

import json
import sys
from contextlib import suppress
from pathlib import Path
from typing import Any

from casper.engine.domain.check import check_domain
from casper.engine.domain.domain import Domain
from casper.kb.checks.check import check_text
from casper.kb.checks.finding import Finding, error
from casper.kb.errors import CasperError, Place
from casper.kb.text.files import DRAFTS, read_utf8

MOST_MEMORY = 4 << 30  # bytes


def main() -> None:
    """Answer line by line until the input ends."""
    _bound()
    for line in sys.stdin.buffer:
        print(json.dumps(answer(json.loads(line))), flush=True)


def answer(asked: dict[str, Any]) -> dict[str, Any]:
    """``{"findings": [finding], "rows": {"name/arity": n}}`` of ``{"folder", "file", "drafts": {path: text}}``."""
    DRAFTS.clear()
    DRAFTS.update({Path(path): text for path, text in asked["drafts"].items()})
    folder, rows = Path(asked["folder"]), dict[str, int]()
    try:
        if asked["file"] is not None:
            findings = check_text(read_utf8(Path(asked["file"])), asked["file"])
        else:
            findings = check_domain(folder)
            rows = _rows(folder)
    except (CasperError, OSError, RecursionError) as mistake:
        place = getattr(mistake, "place", None) or Place(str(folder))
        findings = [error(place, getattr(mistake, "sentence", None) or str(mistake))]
    except MemoryError:
        findings = [error(Place(str(folder)), "this domain takes more memory than the check of an editor may have")]
    return {"findings": [_told(finding) for finding in findings], "rows": rows}


def _rows(folder: Path) -> dict[str, int]:
    """How many rows each predicate has, where they are listed; none of a domain that cannot be loaded."""
    with suppress(CasperError):
        return Domain.load(folder).kb.row_counts()
    return {}


def _told(finding: Finding) -> dict[str, Any]:
    return finding.to_json()


def _bound() -> None:
    """No check takes the editor's machine down."""
    with suppress(ImportError, ValueError, OSError):
        import resource

        resource.setrlimit(resource.RLIMIT_AS, (MOST_MEMORY, MOST_MEMORY))


if __name__ == "__main__":
    main()
