"""``casper doctor``: what is installed, what is missing for which command, and the line that brings it."""

from __future__ import annotations

import sys
from typing import TYPE_CHECKING, Annotated

import typer

from casper.cli.terminal.options import AsJson, Quiet

if TYPE_CHECKING:
    from casper.cli.authoring.installed import Extra, Library


def doctor(
    thorough: Annotated[
        bool, typer.Option("--thorough", help="Import every library, to see that it works; takes a while.")
    ] = False,
    quiet: Quiet = False,
    as_json: AsJson = False,
) -> None:
    """Say what is installed, what is missing for which command, in which versions, and what to type.

    Exit code 0, or 1 where something that is installed is too old, or does not work.
    """
    from casper.cli.authoring.installed import surroundings, survey
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.progress import progress
    from casper.cli.terminal.showing import show
    from casper.kb.text.lines import line

    with progress("importing", None, quiet or not thorough):
        extras = survey(thorough)
    if as_json:
        for name, told in surroundings().items():
            print_json({"name": name, "value": told})
        for extra in extras:
            print_json(extra.to_json())
    else:
        out = console()
        for name, told in surroundings().items():
            show(out, [line(f"{name:<10} {told}")])
        for extra in extras:
            _show(extra)
        missing = [extra.name for extra in extras if extra.name and not extra.install and not extra.is_there]
        if missing:
            show(out, [line(f"everything that is missing: {sys.executable} -m pip install '{_wanted(missing)}'")])
    raise typer.Exit(1 if any(library.wrong for extra in extras for library in extra.libraries) else 0)


def _show(extra: Extra) -> None:
    from casper.cli.terminal.output import console
    from casper.cli.terminal.showing import show
    from casper.kb.text.lines import Span, line

    wrong = any(library.wrong for library in extra.libraries)
    mark = Span("✘", "bad") if wrong else Span("✔", "good") if extra.is_there else Span("○", "warning")
    libraries = ", ".join(map(_told, extra.libraries))
    show(console(), [line(mark, " ", Span(f"{extra.name or 'core':<16}", "strong"), f" {extra.purpose}")])
    show(console(), [line("  ", Span(libraries, "faint"))])
    if extra.name and not extra.is_there:
        install = extra.install or f"pip install '{_wanted([extra.name])}'"
        show(console(), [line(f"  {sys.executable} -m {install}")])


def _told(library: Library) -> str:
    if library.wrong:
        return f"{library.name} {library.version}: {library.wrong}"
    return f"{library.name} {library.version or 'missing'}"


def _wanted(extras: list[str]) -> str:
    return f"casper-hri[{','.join(extras)}]"
