"""``casper lsp``: the language server, for editors."""

from __future__ import annotations

import sys
from typing import Annotated

import typer


def lsp(
    stdio: Annotated[
        bool, typer.Option("--stdio", hidden=True, help="What it does anyway: many editors say so.")
    ] = True,
) -> None:
    """Serve an editor by the Language Server Protocol on standard input and output; editors start it themselves.

    How to set one up: docs/editor.md.
    """
    from casper.cli.terminal.extras import needs
    from casper.cli.terminal.showing import complain

    needs("pygls", "lsp")
    from casper.lsp.server import serve

    if sys.stdin.isatty():
        complain("this talks with an editor, which starts it by itself (docs/editor.md); Ctrl-C ends it")
    serve()
