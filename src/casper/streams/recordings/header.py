"""The first line of a recording: which domain, which settings, which version, so that a replay can be the same."""

from __future__ import annotations

import platform
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from casper import __version__
from casper.engine.domain.digest import digest
from casper.engine.domain.domain import SHIPPED, Domain
from casper.kb.errors import CasperError

FORMAT = 1
SETTINGS: Mapping[str, type | tuple[type, ...]] = {
    "verification": bool,
    "policy": str,
    "helps": bool,
    "noise": (float, int, type(None)),
    "goals": int,
    "stops": bool,
    "certainty": (float, int, type(None)),
}
"""Choices of minds (`engine.mind.Mind`) and what each may be."""


@dataclass(frozen=True, slots=True)
class Header:
    """What a recording is of.

    domain: a shipped one's name, or the folder. digest: of what it stated (`engine.domain.digest`). settings: of the
    minds. seed: of a simulation (``casper run``), whose robot's reports are events, too; None: of a watch.
    """

    domain: str
    digest: str
    language: str | None = None
    settings: Mapping[str, Any] = field(default_factory=dict)
    seed: int | None = None
    casper: str = __version__
    python: str = field(default_factory=platform.python_version)

    @property
    def is_simulated(self) -> bool:
        """Whether it is of a ``casper run``."""
        return self.seed is not None

    def to_json(self) -> dict[str, Any]:
        """The line's object."""
        told = {"type": "recording", "format": FORMAT, "casper": self.casper, "python": self.python}
        told |= {"domain": self.domain, "digest": self.digest, "language": self.language}
        return told | {"settings": dict(self.settings), "seed": self.seed}


def header_of(domain: Domain, language: str | None, settings: Mapping[str, Any], seed: int | None = None) -> Header:
    """The header for a recording of minds of a domain with those settings."""
    is_shipped = domain.folder.resolve().parent == SHIPPED.resolve()
    name = domain.name if is_shipped else str(domain.folder.resolve())
    return Header(name, digest(domain), language, dict(settings), seed)


def header_from_json(data: Mapping[str, Any], file: str) -> Header:
    """Read it back.

    Raises:
        CasperError: it is none, or of a later version.
    """
    if data.get("type") != "recording" or "digest" not in data:
        advice = "its first line does not say of what; casper watch reads world states"
        raise CasperError(f"{file} is no recording: {advice}")
    if data.get("format") != FORMAT:
        told = f"of format {data.get('format')!r:.20}, and this version of casper reads {FORMAT}"
        raise CasperError(f"{file} is a recording {told}")
    settings, seed, texts = data.get("settings"), data.get("seed"), [data.get(key) for key in ("domain", "digest")]
    language = data.get("language")
    fits = isinstance(settings, Mapping) and all(_fits(name, value) for name, value in settings.items())
    if not (fits and all(isinstance(text, str) for text in texts) and isinstance(seed, (int, type(None)))):
        raise CasperError(f"{file}:1: the settings of the recording are none that minds have")
    domain, told = map(str, texts)
    versions = (str(data.get("casper")), str(data.get("python")))
    return Header(domain, told, language if isinstance(language, str) else None, dict(settings or {}), seed, *versions)


def _fits(name: str, value: object) -> bool:
    kind = SETTINGS.get(name)
    return kind is not None and isinstance(value, kind) and (kind is bool or not isinstance(value, bool))
