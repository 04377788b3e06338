"""The languages in which a domain's reasons can be told."""

from __future__ import annotations

from collections.abc import Iterable

from casper.engine.events.phrases import PHRASES
from casper.kb.base import KnowledgeBase
from casper.kb.checks.says import mistake_of
from casper.kb.errors import DomainError, ProgramError
from casper.kb.reasons.says import is_say
from casper.kb.terms.clauses import Clause, Sentence


def languages_of(kb: KnowledgeBase) -> tuple[str, ...]:
    """Those that somebody worded something in, sorted."""
    return tuple(sorted(kb.words.languages))


def speak(kb: KnowledgeBase, language: str, name: str) -> None:
    """Let reasons be told in a language.

    Raises:
        DomainError: nobody worded anything in it, and the system itself says nothing in it; with those there are.
    """
    known = sorted({*languages_of(kb), *PHRASES})
    if language not in known:
        raise DomainError(f"nothing of {name} is said in {language!r}; there are {', '.join(known)}")
    kb.language = language


def check_says(sentences: Iterable[Sentence]) -> None:
    """Refuse a sentence that could not be told.

    Raises:
        ProgramError: with its place, and what to write instead.
    """
    for sentence in sentences:
        mistake = mistake_of(sentence) if isinstance(sentence, Clause) and is_say(sentence) else None
        if mistake is not None:
            raise ProgramError(mistake, sentence.place if sentence.place.line else None)
