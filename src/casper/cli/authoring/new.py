"""``casper new``: a folder of one's own, with a small domain in it that works."""

from __future__ import annotations

import shlex
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated

import typer

from casper.cli.terminal.options import AsJson

MINIMAL = "minimal"
ROOM = ("actions.pl", "movements.pl", "scene.pl")  # what a domain needs in the simulator, and not to reason


def new(
    folder: Annotated[Path, typer.Argument(metavar="FOLDER", help="Where the domain is to be; it must not exist yet.")],
    like: Annotated[str, typer.Option(metavar="NAME", help="The shipped domain to begin with.")] = MINIMAL,
    with_scene: Annotated[
        bool, typer.Option("--with-scene", help="A room, too, so that it runs in the simulator.")
    ] = False,
    as_json: AsJson = False,
) -> None:
    """Begin a domain of your own: a small one that works, with comments that teach, and the next commands to try."""
    from casper.cli.terminal.output import console, print_json
    from casper.cli.terminal.showing import say

    texts = template(like, with_scene)
    written = write(texts, folder)
    commands = next_commands(folder, with_scene)
    if as_json:
        print_json({"folder": str(folder), "like": like, "files": written, "next": commands})
        return
    out = console()
    say(out, f"written to {folder}: {', '.join(written)}")
    say(out, "next:")
    for command in commands:
        say(out, f"    {command}")


def template(like: str, with_scene: bool) -> dict[str, str]:
    """The texts of a shipped domain by file name.

    Raises:
        DomainError: there is no such domain; the sentence names those there are.
    """
    from casper.engine.domain.domain import FILES, SHIPPED, shipped_domains
    from casper.engine.domain.examples import TESTS
    from casper.kb.errors import DomainError

    known = shipped_domains()
    if like not in known:
        close = get_close_matches(like, known, n=1)
        hint = f"did you mean {close[0]}?" if close else "take one of these"
        raise DomainError(f"there is no domain {like!r} to begin with; {hint} ({', '.join(known)})")
    files = [file for file in (*FILES, TESTS) if with_scene or file not in ROOM]
    found = ((file, SHIPPED / like / file) for file in files)
    return {file: path.read_text(encoding="utf-8") for file, path in found if path.is_file()}


def write(texts: dict[str, str], folder: Path) -> list[str]:
    """Write the texts into a folder that is new, or empty; the names of the files.

    Raises:
        DomainError: there is something already, or nothing can be written there.
    """
    from casper.kb.errors import DomainError

    try:
        if folder.exists() and (not folder.is_dir() or any(folder.iterdir())):
            what = "is not empty" if folder.is_dir() else "is a file"
            raise DomainError(f"{folder} {what}, and nothing is written over; give the name of a folder that is new")
        folder.mkdir(parents=True, exist_ok=True)
        for name, text in texts.items():
            with (folder / name).open("x", encoding="utf-8") as file:
                file.write(text)
    except (OSError, ValueError) as mistake:  # ValueError: a name that no file can have
        reason = getattr(mistake, "strerror", None) or mistake
        raise DomainError(f"nothing can be written to {folder} ({reason}); give another folder") from None
    return list(texts)


def next_commands(folder: Path, with_scene: bool) -> list[str]:
    """Three commands to go on with."""
    from casper.engine.domain.examples import examples_of

    where = shlex.quote(str(folder))
    actions = next((example.actions for example in examples_of(folder) if example.actions), ())
    last = f"casper run {where} --seed 1" if with_scene else f'casper query {where} "valid(S)"'
    return [f"casper check {where}", f"casper explain {where} {shlex.join(actions)}", last]
