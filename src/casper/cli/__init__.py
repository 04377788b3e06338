"""The command line. Every command but ``repl`` takes ``--json``: one JSON object a line, nothing else on the output.

Exit codes: 0 done, 1 some statement is not valid (verify) or the domain has errors (check), 2 a mistake, told in one
sentence on standard error.
"""

from __future__ import annotations

import sys

import typer

from casper.cli.check import check
from casper.cli.explain import explain
from casper.cli.import_ import import_
from casper.cli.query import query
from casper.cli.repl import repl
from casper.cli.run import run
from casper.cli.train import train
from casper.cli.verify import verify
from casper.cli.watch import watch
from casper.kb.errors import CasperError

app = typer.Typer(
    name="casper",
    help="Watch a partner, read the goal behind what they do, say why, and help.",
    no_args_is_help=True,
    add_completion=False,
    pretty_exceptions_enable=False,
)
for command in (run, explain, verify, query, repl, watch, check, train):
    app.command()(command)
app.command("import")(import_)


def main() -> None:
    """The ``casper`` command."""
    try:
        app()
    except CasperError as mistake:
        print(f"casper: {mistake}", file=sys.stderr)
        sys.exit(2)
    except BrokenPipeError:  # the reader of a pipe has had enough, as in ``casper … | head``
        sys.stderr.close()
        sys.exit(0)
    except KeyboardInterrupt:
        sys.exit(130)
