"""Examples: what the author of a domain expects of it, stated in its ``tests.pl`` and tried out by ``casper check``.

    example(valid, eat(human, meal, plate)).                       example(invalid, eat(tiago, meal, plate)).
    example(invalid, eat(tiago, meal, plate), "not a human").      % and for this reason
    example(valid, take(ann, pills), [did(eat(ann, bread), 60)]).  % after what happened, with seconds
    example(reads, [pick_and_place(meal, hobs), cook], lunch).     % what these actions are read as
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from dataclasses import dataclass
from difflib import get_close_matches
from pathlib import Path

from casper.engine.domain.domain import SHIPPED, Domain
from casper.kb.errors import CasperError, Place
from casper.kb.reasons.constraints import History
from casper.kb.terms.clauses import Clause, Directive, Sentence
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import NIL, Compound, Term, as_term, list_items, predication
from casper.kb.text.files import is_there
from casper.kb.text.sources import Sources

TESTS = "tests.pl"
_FORMS = (
    "example(valid, Statement), example(valid, Statement, History), example(invalid, Statement), "
    "example(invalid, Statement, Because), example(invalid, Statement, Because, History) "
    "or example(reads, [Action, …], Goal)"
)


@dataclass(frozen=True, slots=True)
class Example:
    """One expectation: ``kind`` is ``valid``, ``invalid`` or ``reads``.

    Of a statement: ``statement``, what must stand in a reason against it, and what happened before, as (statement,
    seconds). Of a reading: ``actions`` and the ``goal`` that they are read as.
    """

    kind: str
    place: Place
    statement: Compound | None = None
    because: str = ""
    history: History = ()
    actions: tuple[str, ...] = ()
    goal: str = ""

    def __str__(self) -> str:
        if self.statement is None:
            return f"{', '.join(self.actions)} reads as {self.goal}"
        because = f", because {self.because!r}" if self.because else ""
        after = f" after {len(self.history)} statements" if self.history else ""
        return f"{term_text(as_term(self.statement))} is {self.kind}{because}{after}"


def examples_of(folder: Path) -> list[Example]:
    """The examples of a domain's folder; none without a ``tests.pl``.

    Raises:
        CasperError: a mistake in the text, or a sentence that is no example, with its place.
    """
    file = folder / TESTS
    return examples_in(Sources((SHIPPED,)).sentences(file)) if is_there(file) else []


def examples_in(sentences: Iterable[Sentence]) -> list[Example]:
    """The examples among sentences (as `examples_of`)."""
    return [_example(sentence) for sentence in sentences if not isinstance(sentence, Directive)]


def failure(domain: Domain, example: Example) -> str | None:
    """Why an example does not hold, with what is so instead; None when it holds."""
    try:
        if example.statement is None:
            return _misread(domain, example)
        return _misjudged(domain, example, example.statement)
    except CasperError as mistake:
        return mistake.sentence


# --- trying one out -------------------------------------------------------------------------------------------------


def _misjudged(domain: Domain, example: Example, statement: Compound) -> str | None:
    if not domain.verifies:
        return "the domain has no ontology.pl, so no statement is valid or invalid in it"
    verdict, shown = domain.kb.verify(statement, example.history), term_text(as_term(statement))
    if verdict.valid is None:
        return f"whether {shown} is valid is not known: {'; '.join(verdict.reasons)}"
    if verdict.valid != (example.kind == "valid"):
        if verdict.valid:
            return f"{shown} is valid, and should not be"
        return f"{shown} is not valid, because {'; '.join(verdict.reasons)}"
    if not verdict.valid and not any(example.because in reason for reason in verdict.reasons):
        return f"{shown} is invalid, but not because {example.because!r}: {'; '.join(verdict.reasons)}"
    return None


def _misread(domain: Domain, example: Example) -> str | None:
    goals = domain.library.goals
    if example.goal not in goals:
        close = get_close_matches(example.goal, goals, n=1)
        hint = f"did you mean {close[0]}?" if close else f"there are {', '.join(goals)}"
        return f"there is no goal {example.goal}; {hint}"
    reading = domain.reading()
    for number, action in enumerate(example.actions, 1):
        reading.observe(action)
        if reading.count == 0:
            why = "; ".join(reading.rejected.get(example.goal, ()))
            return f"{action}, action {number}, fits no plan" + (f"; not {example.goal}: {why}" if why else "")
    if reading.outcome == example.goal:
        return None
    shares = ", ".join(f"{goal} {share:.2f}" for goal, share in reading.posterior.items() if share)
    found = f"reads as {reading.outcome}" if reading.outcome else "leaves the goal open"
    return f"{', '.join(example.actions)} {found} ({shares}), not as {example.goal}"


# --- reading the text -----------------------------------------------------------------------------------------------


def _example(sentence: Sentence) -> Example:
    if not isinstance(sentence, Clause) or sentence.body or sentence.head.functor != "example":
        raise CasperError(f"{TESTS} holds examples only: {_FORMS}", sentence.place)
    kind, *rest = sentence.head.args or ("",)
    made = _MAKERS.get((kind, len(rest))) if isinstance(kind, str) else None
    if made is None:
        raise CasperError(f"{term_text(as_term(sentence.head))} is no example; write {_FORMS}", sentence.place)
    return made(sentence.place, *rest)


def _valid(place: Place, statement: Term, history: Term = NIL) -> Example:
    return Example("valid", place, _statement(statement, place), history=_history(history, place))


def _invalid(place: Place, statement: Term, because: Term = "", history: Term = NIL) -> Example:
    if not isinstance(because, str):
        raise CasperError(f"a reason is a text, not {term_text(because)}", place)
    return Example("invalid", place, _statement(statement, place), because, _history(history, place))


def _reads(place: Place, actions: Term, goal: Term) -> Example:
    seen = tuple(term_text(action) for action in _listed(actions, place))
    if not seen:
        raise CasperError("an empty list of actions reads as nothing", place)
    return Example("reads", place, actions=seen, goal=term_text(goal))


_MAKERS: dict[tuple[str, int], Callable[..., Example]] = {
    ("valid", 1): _valid,
    ("valid", 2): _valid,
    ("invalid", 1): _invalid,
    ("invalid", 2): _invalid,
    ("invalid", 3): _invalid,
    ("reads", 2): _reads,
}


def _statement(term: Term, place: Place) -> Compound:
    try:
        return predication(term)
    except TypeError:
        raise CasperError(f"{term_text(term)} is no statement: write action(agent, …)", place) from None


def _history(term: Term, place: Place) -> History:
    return tuple(_happened(item, place) for item in _listed(term, place))


def _happened(item: Term, place: Place) -> tuple[Term, float]:
    if isinstance(item, Compound) and item.indicator == ("did", 2):
        statement, seconds = item.args
        if isinstance(seconds, (int, float)):
            return _statement(statement, place), float(seconds)
    raise CasperError(f"{term_text(item)} is nothing that happened: write did(Statement, Seconds)", place)


def _listed(term: Term, place: Place) -> Iterator[Term]:
    items, tail = list_items(term)
    if tail != NIL:
        raise CasperError(f"{term_text(term)} is no list: write [a, b]", place)
    yield from items
