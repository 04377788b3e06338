"""What a server remembers of a client: the domain, and the readings by name."""

from __future__ import annotations

from typing import Any

from casper.engine.domain.domain import Domain
from casper.engine.domain.partners.remembered import Remembered
from casper.engine.reading.reading import Reading
from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError

DEFAULT = "partner"  # the reading that is meant where none is named; it is there from the start
MOST_READINGS = 1000
MOST_ANSWERS = 1000  # to questions that may be asked again


class Conversation:
    """A domain and the readings of it that the client opened."""

    def __init__(self, domain: Domain) -> None:
        self.domain = domain
        self._readings: dict[str, Reading] = {}
        self.remembered = Remembered(domain.kb, MOST_ANSWERS)  # answers of the knowledge base as it is

    @property
    def kb(self) -> KnowledgeBase:
        """The domain's relations."""
        return self.domain.kb

    def reading(self, name: str) -> Reading:
        """A reading by its name.

        Raises:
            CasperError: nobody opened one of that name.
        """
        if name not in self._readings:
            if name != DEFAULT:
                raise CasperError(f"there is no reading {name!r}; open it first")
            self.open(name)
        return self._readings[name]

    def open(self, name: str, **options: Any) -> str:
        """Begin a reading of that name; its name.

        Raises:
            CasperError: options that make no sense, no plans, or more readings than are kept.
        """
        return self.keep(name, self.domain.reading(**options))

    def keep(self, name: str, reading: Reading) -> str:
        """Remember a reading by a name; the name.

        Raises:
            CasperError: there are too many.
        """
        if name not in self._readings and len(self._readings) >= MOST_READINGS:
            raise CasperError(f"there are {MOST_READINGS} readings already; close one first")
        self._readings[name] = reading
        return name

    def close(self, name: str) -> bool:
        """Forget a reading; whether there was one."""
        return self._readings.pop(name, None) is not None
