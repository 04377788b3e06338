"""``casper serve``: a domain for programs in any language, as JSON-RPC 2.0 on standard input and output."""

from __future__ import annotations

from typing import Annotated

import typer

from casper.cli.terminal.options import Language

Domain = Annotated[str | None, typer.Argument(help="A shipped domain or the folder of one.", metavar="DOMAIN")]


def serve(
    domain: Domain = None,
    schema: Annotated[bool, typer.Option("--schema", help="Print the methods (OpenRPC) and exit.")] = False,
    seconds: Annotated[
        float, typer.Option("--limit", min=0.001, metavar="SECONDS", help="How long a question may take.")
    ] = 60.0,
    longest: Annotated[int, typer.Option("--line", min=100, metavar="BYTES", help="How long a line may be.")] = 1 << 24,
    language: Language = None,
) -> None:
    """Answer requests, one JSON object a line, until the input ends.

    Every request is answered in order, a mistake by an error object with a sentence. Nothing else is printed.
    """
    import json
    import sys
    from contextlib import redirect_stdout

    from casper.kb.errors import CasperError

    if schema:
        from casper.server.schema import document

        print(json.dumps(document(), ensure_ascii=False, indent=1))
        return
    if domain is None:
        raise CasperError("say what to serve: casper serve DOMAIN (or casper serve --schema)")
    from casper.engine.domain.domain import Domain
    from casper.server.serving import Server

    server = Server(Domain.load(domain, language), seconds, longest)
    sink = sys.stdout.buffer
    with redirect_stdout(sys.stderr):  # whatever is printed on the way must not stand among the answers
        server.serve(sys.stdin.buffer, sink)
