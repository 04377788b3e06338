"""A domain: one folder of text, read into a knowledge base and a plan library.

    >>> kitchen = Domain.load("kitchen")
    >>> kitchen.kb.ask("wash(tiago, plate, sink)")
    True
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields, replace
from functools import cached_property
from pathlib import Path
from threading import Lock
from typing import Any

from casper.engine.domain.printing import domain_lines, domain_name
from casper.engine.explanation.situation import Situation
from casper.engine.reading.policy import policy_named
from casper.engine.reading.priors import priors_of
from casper.engine.reading.reading import Reading
from casper.engine.recognition.options import Options
from casper.engine.recognition.scoring import score_named
from casper.engine.verification.matching import Agents, Matcher, Mismatch, NameMatcher, ParameterMatcher, bindings_of
from casper.engine.verification.verified_matching import VerifyingMatcher, settle
from casper.kb.base import KnowledgeBase
from casper.kb.errors import DomainError, PlanError
from casper.kb.program.refusals import undefined_sentence
from casper.kb.terms.clauses import Clause, Production, Sentence
from casper.kb.terms.terms import Compound, as_term
from casper.kb.terms.unification import substitute
from casper.kb.text.files import is_there, real
from casper.kb.text.lines import Line, text_of
from casper.kb.text.sources import Sources, fingerprint
from casper.plans.grammar.conditions import condition_clauses
from casper.plans.library import GOAL, PlanLibrary
from casper.plans.relations import RELATIONS, plan_clauses

ONTOLOGY = "ontology.pl"
FILES = (ONTOLOGY, "plans.pl", "actions.pl", "movements.pl", "scene.pl")
PRIOR = ("prior", 2)
MOST_KEPT = 8  # readings to make others of
SHIPPED = Path(__file__).resolve().parent.parent.parent / "domains"


@dataclass(frozen=True)
class Domain:
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
    def load(cls, name: str | Path) -> Domain:
        """Load a shipped domain by its name, or any folder by its path.

        Raises:
            DomainError: no such domain, or a folder with nothing in it (the sentence lists the shipped ones), or a file
            that is no regular one or too large.
            ReadError, ProgramError, PlanError: a mistake in its text, with file and line.
        """
        folder = find_domain(name)
        sources, possible = Sources((SHIPPED,)), [folder / file for file in FILES]
        sentences = {file.name: sources.sentences(file) for file in possible if is_there(file)}
        files = tuple(dict.fromkeys(sources.files))
        return replace(build(folder.name, folder, sentences), files=files, fingerprint=fingerprint([*possible, *files]))

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

    @property
    def partner(self) -> str:
        """The agent that is watched: ``setting(agents, partner, Name)``, else the first human there is."""
        return self._agent("partner", "human", "human")

    @property
    def robot(self) -> str:
        """The agent that helps: ``setting(agents, robot, Name)``, else the first robot there is."""
        return self._agent("robot", "robot", "robot")

    def _agent(self, role: str, kind: str, otherwise: str) -> str:
        for section, key, name in self.kb.rows("setting", 3):
            if (section, key) == ("agents", role):
                return str(name)
        return next((str(row[0]) for row in self.kb.rows(kind, 1)), otherwise)

    def reading(
        self,
        policy: str = "strict",
        verification: bool = True,
        noise: float | None = None,
        goals: int = 1,
        score: str = "paper",
        budget: int | None = None,
    ) -> Reading:
        """A fresh reading of a partner; with ``noise`` and ``goals`` left alone it is the paper's.

        Readings of several partners share the library's tables and what the knowledge base said.

        Args:
            policy: ``strict`` or ``best`` (`engine.reading.policy`).
            verification: False sees action names only and never asks the knowledge base about an observation.
            noise: the factor on a score for each observation that is needless or misread; None: there are none.
            goals: how many goals the partner may pursue at once.
            score: the name of a score (`engine.recognition.scoring`).
            budget: how many states are kept (None: 20,000; of two goals at once 50,000, of more 3,000). Where there
                are more, the reading is not exact, and says so.

        Raises:
            CasperError: no such policy or score, a price or a number of goals that is none, or priors that do not
                sum to 1. PlanError: the domain has no plans.
        """
        if not self.library.ways:
            raise PlanError(f"the domain {self.name} has no plans to explain anything with; add them in plans.pl")
        Options(noise, goals, budget=budget).check()
        key = (policy, verification, noise, goals, score, budget, self.kb.changes)
        with self._lock:  # partners may be read in threads of their own
            if key not in self._unread:
                options = Options(noise, goals, self._priors(), score_named(score), budget)
                matcher = self._matcher(verification)
                fresh = Reading(self.library, matcher, policy_named(policy), self.capability, options)
                if len(self._unread) >= MOST_KEPT or any(other[-1] != key[-1] for other in self._unread):
                    self._unread.clear()
                self._unread[key] = fresh
            return self._unread[key].fork()

    @cached_property
    def _lock(self) -> Lock:
        return Lock()

    def _priors(self) -> dict[str, float]:
        places = {clause.head.args: clause.place for clause in self.kb.clauses_of(PRIOR)}
        return priors_of(self.kb.rows(*PRIOR), self.library.goals, places.get)

    @cached_property
    def _unread(self) -> dict[tuple[Any, ...], Reading]:
        """Readings in which nothing was observed, by their options and the state of the knowledge base."""
        return {}

    def _matcher(self, verification: bool) -> Matcher:
        if not verification:
            return NameMatcher(self.library.ways)
        if not self.verifies:
            return ParameterMatcher(self.library.ways, Agents(self.partner, self.robot))
        return VerifyingMatcher(self.library.ways, self.kb, self.partner, self.robot)

    def capability(self, situation: Situation, leaf: int, agent: str) -> tuple[Compound, bool]:
        """A leaf's action with every part filled in that can be, and whether the knowledge base lets the agent do it.

        What was done, and what comes before the leaf, is taken as done by then. A domain that verifies nothing lets
        nobody do anything.
        """
        plan = situation.plan
        binding = situation.binding or (None,) * len(plan.variables)
        by = plan.actions[leaf].by
        who = None if by is None else Agents(self.partner, self.robot).named(substitute(by, bindings_of(plan, binding)))
        if not self.verifies or (isinstance(who, str) and who != agent):
            return situation.leaves[leaf], False
        settled = settle(self.kb, plan, binding[: len(plan.variables)]) if self.kb.defines(*GOAL) else binding
        known = bindings_of(plan, binding if isinstance(settled, Mismatch) else settled)
        actions = [substitute(action, known) for action in plan.leaves]
        done = situation.done | plan.chart.before[leaf] & situation.belonging
        earlier = [action for at, action in enumerate(actions) if done >> at & 1]
        history = [(Compound((a.functor, self.partner, *a.args)), float(t)) for t, a in enumerate(earlier)]
        action = actions[leaf]
        verdict = self.kb.verify(Compound((action.functor, agent, *action.args)), history)
        filled = verdict.completed if verdict.valid else verdict.statement
        return Compound((filled.functor, *filled.args[1:])), verdict.valid is True


def find_domain(name: str | Path) -> Path:
    """The folder of a shipped domain or of a path.

    Raises:
        DomainError: there is none, or the folder holds no domain file.
    """
    shipped = sorted(p.name for p in SHIPPED.iterdir() if p.is_dir() and any(is_there(p / f) for f in FILES))
    folder = Path(name)
    if str(name) in shipped and not os.path.isdir(folder):
        return SHIPPED / str(name)
    if not os.path.isdir(folder):
        raise DomainError(f"there is no domain {str(name)!r}: give a folder, or one of {', '.join(shipped)}")
    if not any(is_there(folder / file) for file in FILES):
        if str(name) in shipped:
            return SHIPPED / str(name)
        raise DomainError(f"the folder {name} holds no domain: it needs {ONTOLOGY} or plans.pl")
    return real(folder)


def build(name: str, folder: Path, sentences: dict[str, list[Sentence]]) -> Domain:
    """A domain from sentences by file name.

    Raises:
        ProgramError, PlanError: a mistake in the text, with file and line.
    """
    verifies = ONTOLOGY in sentences
    everything = [sentence for found in sentences.values() for sentence in found]
    library = PlanLibrary(everything)
    kb = KnowledgeBase()
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
