"""``casper lsp``: the language server, for editors."""

from __future__ import annotations


def lsp() -> None:
    """Serve an editor by the Language Server Protocol on standard input and output; editors start it themselves.

    How to set one up: docs/editor.md.
    """
    from casper.cli.terminal.extras import needs

    needs("pygls", "lsp")
    from casper.lsp.server import serve

    serve()
