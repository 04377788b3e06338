"""``casper repl``: ask a domain one thing after the other, in a terminal or through a pipe."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING

from casper.cli.terminal.options import DomainName, Language

if TYPE_CHECKING:
    from casper.cli.asking.session import Session

HISTORY = Path("~/.casper_history")
_PROMPT = "?- "
_DELIMITERS = " \t\n(),;\\+=<>[]|"


def repl(domain: DomainName, language: Language = None) -> None:
    """Talk with a domain: queries, why, why not, repair, observe, explain, listing; :help says how.

    In a terminal there are a history and completion (Tab). Lines that come through a pipe are answered likewise.
    """
    from casper.cli.asking.session import Session
    from casper.cli.terminal.showing import say
    from casper.engine.domain.domain import Domain

    session = Session(Domain.load(domain, language))
    terminal = sys.stdin.isatty()
    if terminal:
        say(session.out, f"{session.domain.name}: ask, or :help, or :quit")
    for line in _typed(session) if terminal else sys.stdin:
        if line.strip() in (":quit", ":q", "halt."):
            return
        session.answer(line)


def _typed(session: Session) -> Iterator[str]:
    """Lines from a terminal, with history and completion where the platform has readline."""
    _prepare(session)
    while True:
        try:
            yield input(_PROMPT)
        except EOFError:
            session.out.print()
            return
        except KeyboardInterrupt:  # gives the line up, not the session
            session.out.print()


def _prepare(session: Session) -> None:
    try:
        import readline
    except ImportError:  # Windows: no history, but everything else
        return
    import atexit

    def complete(text: str, state: int) -> str | None:
        fitting = session.completions(readline.get_line_buffer()[: readline.get_endidx()], text)
        return fitting[state] if state < len(fitting) else None

    history = HISTORY.expanduser()
    with suppress(OSError):
        readline.read_history_file(history)
    readline.set_history_length(1000)
    readline.set_completer_delims(_DELIMITERS)
    readline.set_completer(complete)
    readline.parse_and_bind("tab: complete")

    def save() -> None:
        with suppress(OSError):
            readline.write_history_file(history)

    atexit.register(save)
