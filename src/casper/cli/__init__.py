"""The command line. Every command takes ``--json`` (but ``repl``, ``batch`` and ``serve``): one JSON
object a line, nothing else on the output. Its exit codes are in `cli.terminal.codes`.
"""

from __future__ import annotations

import errno
import os
import sys
from contextlib import suppress
from typing import Annotated

import typer

from casper import __version__
from casper.cli.asking.explain import explain
from casper.cli.asking.query import query
from casper.cli.asking.repl import repl
from casper.cli.asking.serve import serve
from casper.cli.asking.verify import verify
from casper.cli.authoring.check import check
from casper.cli.authoring.doctor import doctor
from casper.cli.authoring.import_ import import_
from casper.cli.authoring.lsp import lsp
from casper.cli.authoring.new import new
from casper.cli.authoring.train import train
from casper.cli.terminal.codes import epilog
from casper.cli.terminal.plain import settle_streams
from casper.cli.terminal.showing import complain
from casper.cli.watching.batch import batch
from casper.cli.watching.experiment import experiment
from casper.cli.watching.record import record
from casper.cli.watching.replay import replay
from casper.cli.watching.run import run
from casper.cli.watching.watch import watch
from casper.kb.errors import CasperError

_NO_ROOM = (errno.ENOSPC, errno.EDQUOT, errno.EFBIG)

app = typer.Typer(
    name="casper",
    add_completion=True,
    pretty_exceptions_enable=False,
    epilog=epilog(),
    rich_markup_mode=None,  # plain help: nothing is cut off in a narrow terminal, and no text is taken for markup
)
asked, watching = (explain, verify, query, repl, serve, batch), (watch, record, replay, experiment)
for command in (run, *asked, *watching, check, new, train, import_, lsp, doctor):
    name = command.__name__.rstrip("_")
    # a sentence in whole, not its beginning
    app.command(name, short_help=(command.__doc__ or "").split("\n")[0])(command)


@app.callback(invoke_without_command=True)
def casper(
    context: typer.Context,
    version: Annotated[bool, typer.Option("--version", help="Print the version and exit.")] = False,
) -> None:
    """Watch a partner, read the goal behind what they do, say why, and help."""
    if version:
        print(f"casper {__version__}")
        raise typer.Exit()
    if context.invoked_subcommand is None:
        print(context.get_help())


def main() -> None:
    """The ``casper`` command."""
    settle_streams()
    try:
        try:
            app()
        finally:
            sys.stdout.flush()
    except CasperError as mistake:
        complain(str(mistake))
        sys.exit(2)
    except (SystemExit, OSError) as end:
        _end_of_output(end)
        raise
    except KeyboardInterrupt:
        sys.exit(130)


def _end_of_output(end: SystemExit | OSError) -> None:
    """Leave, if nothing can be written any more; what is still to be written must not be tried again at the end."""
    had_enough = isinstance(end, BrokenPipeError) or isinstance(end.__context__, BrokenPipeError)
    if not had_enough and isinstance(end, SystemExit):
        return
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    if had_enough:  # the reader of a pipe, as in ``casper … | head``
        sys.exit(0)
    assert isinstance(end, OSError)
    wrong = "cannot write the output" if end.errno in _NO_ROOM else "cannot go on"
    print(f"casper: {wrong} ({end.strerror or end})", file=sys.stderr)
    sys.exit(2)
