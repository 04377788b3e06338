"""A domain: one folder of text, read into a knowledge base and a plan library.

>>> kitchen = Domain.load("kitchen")
>>> kitchen.kb.ask("wash(tiago, plate, sink)")
True
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, replace
from difflib import get_close_matches
from pathlib import Path
from typing import Any

from casper.engine.domain.languages import check_says, speak
from casper.engine.domain.partners.readings import Readings
from casper.engine.domain.printing import domain_lines, domain_name
from casper.engine.perception.remembering.asked import ASKED
from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError, PlanError
from casper.kb.program.refusals import undefined_sentence
from casper.kb.terms.clauses import Clause, Production, Sentence
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.files import is_there, real
from casper.kb.text.lines import Line, Shown, text_of
from casper.kb.text.reader import read_text
from casper.kb.text.sources import Sources, fingerprint
from casper.plans.grammar.conditions import condition_clauses
from casper.plans.library import GOAL, PlanLibrary
from casper.plans.relations import RELATIONS, plan_clauses

ONTOLOGY = "ontology.pl"
FILES = (ONTOLOGY, "plans.pl", "actions.pl", "movements.pl", "scene.pl", "words.pl")
SHIPPED = Path(__file__).resolve().parent.parent.parent / "domains"


@dataclass(frozen=True)
class Domain(Readings, Shown):
    """What is known of one place: relations, plans, and the settings of every stage as facts among the relations.

    ``verifies`` is False for a folder without ``ontology.pl``: such a domain verifies nothing and only explains.
    ``files`` are all the files it was read from, those that others include or use among them, and ``fingerprint`` tells
    whether they have changed (`engine.domain.reload`).
    """

    name: str
    folder: Path
    kb: KnowledgeBase
    library: PlanLibrary
    verifies: bool
    files: tuple[Path, ...] = ()
    fingerprint: str = ""

    @classmethod
    def load(cls, name: str | Path, language: str | None = None) -> Domain:
        """Load a shipped domain by its name, or any folder by its path.

        Args:
            name: the domain.
            language: in which reasons are told, as far as the domain words them (``say/3``); None: as ``say/2`` has it.

        Raises:
            DomainError: no such domain, or a folder with nothing in it (the sentence lists the shipped ones), or a file
                that is no regular one or too large, or a language in which nothing is said.
            ReadError, ProgramError, PlanError: a mistake in its text, with file and line.
        """
        folder = find_domain(name)
        sources, possible = Sources((SHIPPED,)), [folder / file for file in FILES]
        sentences = {file.name: sources.sentences(file) for file in possible if is_there(file)}
        files = tuple(dict.fromkeys(sources.files))
        built = build(folder.name, folder, sentences)
        if language:
            speak(built.kb, language, folder.name)
        return replace(built, files=files, fingerprint=fingerprint([*possible, *files]))

    @classmethod
    def from_text(
        cls,
        ontology: str | None = None,
        plans: str | None = None,
        actions: str | None = None,
        movements: str | None = None,
        scene: str | None = None,
        words: str | None = None,
        name: str = "text",
    ) -> Domain:
        """A domain without a folder: the texts that would stand in its files; None: there is no such file.

        Raises:
            ReadError, ProgramError, PlanError: a mistake in a text, with the name of its file and the line. There is
                nothing to include or use from here.
        """
        texts = dict(zip(FILES, (ontology, plans, actions, movements, scene, words)))
        sentences = {file: read_text(text, file) for file, text in texts.items() if text is not None}
        return build(name, Path(f"<{name}>"), sentences)

    def __getstate__(self) -> dict[str, Any]:
        """Its fields alone: readings, and what was worked out for them, are made anew where it arrives."""
        return {field.name: getattr(self, field.name) for field in fields(self)}

    def lines(self) -> Iterator[Line]:
        """What a person is shown."""
        return domain_lines(self)

    def __str__(self) -> str:
        return text_of(self.lines())

    def __repr__(self) -> str:
        return domain_name(self)


def find_domain(name: str | Path) -> Path:
    """The folder of a shipped domain or of a path.

    Raises:
        DomainError: there is none, or the folder holds no domain file.
    """
    shipped = shipped_domains()
    folder = Path(name)
    if str(name) in shipped and not os.path.isdir(folder):
        return SHIPPED / str(name)
    if not os.path.isdir(folder):
        close = get_close_matches(str(name), shipped, n=1)
        hint = f"; did you mean {close[0]}?" if close else ""
        raise DomainError(f"there is no domain {str(name)!r}: give a folder, or one of {', '.join(shipped)}{hint}")
    if not any(is_there(folder / file) for file in FILES):
        if str(name) in shipped:
            return SHIPPED / str(name)
        raise DomainError(f"the folder {name} holds no domain: it needs {ONTOLOGY} or plans.pl")
    return real(folder)


def shipped_domains() -> list[str]:
    """The names of the domains that come with the package, without the texts that are there for them to include."""
    return sorted(p.name for p in SHIPPED.iterdir() if any(is_there(p / file) for file in FILES[:2]))


def build(name: str, folder: Path, sentences: dict[str, list[Sentence]]) -> Domain:
    """A domain from sentences by file name.

    Raises:
        ProgramError, PlanError: a mistake in the text, with file and line.
    """
    verifies = ONTOLOGY in sentences
    everything = [sentence for found in sentences.values() for sentence in found]
    check_says(everything)
    library = PlanLibrary(everything)
    kb = KnowledgeBase()
    kb.offer(ASKED)
    kb.add(_knowledge(everything, verifies))
    if verifies:
        kb.add(condition_clauses(library.productions))
    written = {s.head.indicator for s in everything if isinstance(s, Clause)}
    derived = [clause for clause in plan_clauses(library) if clause.head.indicator not in written]
    library.check()
    if library.productions and not library.goal_clauses:
        goals = [p.goal for p in library.ways] if library.is_listed else [goal for goal, _ in library.goal_terms]
        kb.add(Clause(Compound(("goal", as_term(goal)))) for goal in goals)
    kb.add(derived)
    kb.declare_statements((action, arity + 1) for action, arity in library.actions)
    kb.compile()
    if verifies:
        _check_actions(library, kb)
    return Domain(name, folder, kb, library, verifies)


def _knowledge(sentences: Iterable[Sentence], verifies: bool) -> Iterable[Sentence]:
    """What the knowledge base holds: everything but productions.

    Without an ontology the conditions of goals cannot be asked, so the goals hold unconditionally.
    """
    for sentence in sentences:
        if isinstance(sentence, Production):
            continue
        if isinstance(sentence, Clause) and sentence.head.indicator == GOAL and not verifies:
            yield Clause(sentence.head, (), sentence.place)
        else:
            yield sentence


def _check_actions(library: PlanLibrary, kb: KnowledgeBase) -> None:
    """Refuse a plan with an action that the ontology does not know: nobody could ever do it."""
    for (action, arity), place in library.actions.items():
        if not kb.defines(action, arity + 1):
            known = {(name, at - 1) for name, at in _indicators(kb) if at > 0 and (name, at - 1) not in RELATIONS}
            hint = undefined_sentence((action, arity), known).split("; ", 1)[-1]
            sentence = f"a plan has the action {action}/{arity}, but no rule {action}/{arity + 1} says when it is valid"
            raise PlanError(f"{sentence}; {hint}", place)


def _indicators(kb: KnowledgeBase) -> set[tuple[str, int]]:
    return {clause.head.indicator for clause in kb.clauses}
