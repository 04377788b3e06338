"""What the printers of the commands share: a console that shows texts as they are, and JSON lines."""

from __future__ import annotations

import json
import sys
from typing import Any

from rich.console import Console


def console() -> Console:
    """The terminal; plain text, in lines as long as they are, when it is none. Texts go to it through `showing`."""
    return Console(highlight=False, soft_wrap=not sys.stdout.isatty(), emoji=False, markup=False)


def print_json(data: dict[str, Any]) -> None:
    r"""One JSON object on one line, at once; with ``\u`` escapes where the output cannot hold its characters."""
    line = json.dumps(data, ensure_ascii=False)
    try:
        line.encode(getattr(sys.stdout, "encoding", None) or "utf-8")
    except UnicodeEncodeError:
        line = json.dumps(data)
    print(line, flush=True)
