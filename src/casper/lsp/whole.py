"""The whole of ``casper check`` in a process of its own: it may take long, and can be stopped at any time.

The process reads a line of JSON (a folder, and the texts of the editor that are not on disk) and writes one (findings,
and how many rows each predicate has).
"""

from __future__ import annotations

import asyncio
import json
import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from casper.kb.checks.finding import Finding, Severity
from casper.kb.errors import Place
from casper.lsp.workspace import Domain

SECONDS = 30.0
LONGEST = 1 << 26  # bytes of an answer


@dataclass(frozen=True)
class Checked:
    """What the whole check found, and the rows of each predicate by ``name/arity``."""

    findings: list[Finding]
    rows: dict[str, int] = field(default_factory=dict)


class WholeCheck:
    """Asks the process, and starts it anew where it was stopped or died."""

    def __init__(self) -> None:
        self._process: asyncio.subprocess.Process | None = None

    async def run(self, domain: Domain, drafts: dict[Path, str]) -> Checked | None:
        """The findings; None where the check took too long, or failed."""
        process = await self._started()
        assert process.stdin is not None and process.stdout is not None
        asked = {
            "folder": str(domain.folder),
            "file": None if domain.is_domain else str(domain.docs[0].path) if domain.docs else None,
            "drafts": {str(path): text for path, text in drafts.items()},
        }
        try:
            process.stdin.write(json.dumps(asked).encode() + b"\n")
            await process.stdin.drain()
            line = await asyncio.wait_for(process.stdout.readline(), SECONDS)
            return _checked(json.loads(line)) if line else None
        except (TimeoutError, OSError, ValueError):
            self.stop()
            return None
        except asyncio.CancelledError:
            self.stop()  # what it is at is no longer wanted
            raise

    def stop(self) -> None:
        """End the process."""
        if self._process is not None and self._process.returncode is None:
            self._process.kill()
        self._process = None

    async def _started(self) -> asyncio.subprocess.Process:
        if self._process is None or self._process.returncode is not None:
            pipe = asyncio.subprocess.PIPE
            command = (sys.executable, "-m", "casper.lsp.checking")
            self._process = await asyncio.create_subprocess_exec(
                *command, stdin=pipe, stdout=pipe, stderr=asyncio.subprocess.DEVNULL, limit=LONGEST
            )
        return self._process


def _checked(told: dict[str, Any]) -> Checked:
    return Checked([_finding(each) for each in told["findings"]], told["rows"])


def _finding(told: dict[str, Any]) -> Finding:
    place = Place(told["file"], told["line"], told["column"])
    return Finding(place, Severity(told["severity"]), told["message"])
