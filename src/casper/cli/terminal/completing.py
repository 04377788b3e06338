"""What a shell may complete: shipped domains, folders with a domain, the goals of one."""

from __future__ import annotations

import os
from pathlib import Path


def domains(incomplete: str) -> list[str]:
    """Shipped domains by name, and folders: those that hold a domain, or lead to further ones."""
    from casper.engine.domain.domain import shipped_domains

    names = [name for name in shipped_domains() if name.startswith(incomplete)]
    start = Path(incomplete)
    above = start if incomplete.endswith("/") or not incomplete else start.parent
    try:
        folders = sorted(folder for folder in above.iterdir() if folder.is_dir() and not folder.name.startswith("."))
    except OSError:
        folders = []
    return [*names, *(f"{folder}/" for folder in folders if str(folder).startswith(incomplete.removeprefix("./")))]


def typed_domain(command: str) -> str:
    """The domain on the line that is being completed, as far as it is typed; the shell hands the line on so."""
    line = os.environ.get("_TYPER_COMPLETE_ARGS") or os.environ.get("COMP_WORDS") or ""
    words = line.split()
    behind = words[words.index(command) + 1 :] if command in words else []
    return next((word for word in behind if not word.startswith("-")), "")


def goals(domain: str, incomplete: str) -> list[str]:
    """The goals of a domain that begin so; none where it cannot be read."""
    from casper.engine.domain.domain import Domain
    from casper.kb.errors import CasperError

    try:
        return [goal for goal in Domain.load(domain).library.goals if goal.startswith(incomplete)]
    except (CasperError, OSError):
        return []


def behaviours(incomplete: str) -> list[str]:
    """How a simulated partner may behave; of several with commas the last is completed."""
    from casper.sim_adapter.partners.behaviours.table import NAMES

    before, comma, begun = incomplete.rpartition(",")
    return [f"{before}{comma}{name}" for name in NAMES if name.startswith(begun)]
