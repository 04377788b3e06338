"""Names in a question that the domain has nowhere: told beside the answer, never instead of it."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

from casper.cli.terminal.showing import complain

if TYPE_CHECKING:
    from casper.engine.domain.domain import Domain


def hints(domain: Domain, questions: Iterable[str]) -> list[str]:
    """A sentence for every name in the questions that stands nowhere in the domain."""
    from casper.kb.checks.strangers import strangers

    return list(dict.fromkeys(str(found) for question in questions for found in strangers(domain.kb, question)))


def hint(domain: Domain, questions: Iterable[str], quiet: bool = False) -> None:
    """Print the sentences on standard error: they are no part of the answer."""
    for sentence in [] if quiet else hints(domain, questions):
        complain(sentence)
