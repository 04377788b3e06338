"""Settings that no stage understands, each with its place."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from difflib import get_close_matches
from typing import Any

from casper.engine.actions.prediction import action_settings
from casper.engine.collaboration.acting import acting_settings
from casper.engine.domain.partners.agents import strangers
from casper.engine.domain.relations import SECTIONS
from casper.engine.episodes.prices import prices_of
from casper.engine.movements.leaves import TIMED
from casper.engine.movements.movements import movement_classifier
from casper.engine.perception.focus import focus_settings
from casper.engine.perception.perception import perception_settings
from casper.engine.perception.remembering.memory import memory_settings
from casper.engine.perception.tracking import tracker_settings
from casper.engine.settings import Rows
from casper.engine.verification.history import history_settings
from casper.kb.base import KnowledgeBase
from casper.kb.checks.finding import Finding, error, warning
from casper.kb.errors import CasperError, Place
from casper.kb.terms.clauses import Clause

_STAGES: tuple[tuple[str, int, Callable[[Rows], Any]], ...] = (
    ("setting", 3, perception_settings),
    ("setting", 3, tracker_settings),
    ("setting", 3, focus_settings),
    ("setting", 3, memory_settings),
    ("setting", 3, action_settings),
    ("setting", 3, history_settings),
    ("setting", 3, acting_settings),
    ("setting", 3, prices_of),
    ("movement", 5, movement_classifier),
)
_QUOTED = re.compile(r"(\w+)\((\w+)(?:, (\w+))?")


def wrong_settings(kb: KnowledgeBase) -> Iterator[Finding]:
    """What the stages of the mind refuse of the facts that are meant for them."""
    for clause in kb.clauses_of(("setting", 3)):
        section = clause.head[1]
        if section not in SECTIONS:
            close = get_close_matches(str(section), SECTIONS, n=1)
            hint = f"did you mean {close[0]}?" if close else f"there are {', '.join(SECTIONS)}"
            yield warning(clause.place, f"nothing reads settings of {section}; {hint}")
    yield from (error(place, sentence) for place, sentence in strangers(kb))
    stages = (*_STAGES, (*TIMED, lambda rows: movement_classifier(rows, kb.clauses_of(TIMED))))
    for name, arity, stage in stages:
        if kb.clauses_of((name, arity)):
            try:
                stage(kb.rows)
            except CasperError as mistake:
                yield error(mistake.place or _place(kb, mistake.sentence, (name, arity)), mistake.sentence)


def _place(kb: KnowledgeBase, sentence: str, otherwise: tuple[str, int]) -> Place:
    """The fact that the sentence quotes, or the first clause of the relation it is about."""
    quoted = _QUOTED.search(sentence)
    first: Clause | None = next(iter(kb.clauses_of(otherwise)), None)
    if quoted is not None:
        words = [word for word in quoted.groups()[1:] if word is not None]
        for clause in reversed(kb.clauses):  # of two values the later one is the mistake
            if clause.head.functor == quoted[1] and [str(a) for a in clause.head.args[: len(words)]] == words:
                return clause.place
    return first.place if first is not None else Place()
