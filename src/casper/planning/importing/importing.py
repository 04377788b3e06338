"""The whole way: a problem becomes the text of a domain, and whatever it cannot say becomes a finding.

    >>> domain = from_problem(problem)                                      # doctest: +SKIP
    >>> domain.kb.verify("drive(human, truck, depot, shop)").valid          # doctest: +SKIP
    True
"""

from __future__ import annotations

import warnings
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, TypeAlias

from unified_planning.model import Problem
from unified_planning.model.htn import HierarchicalProblem, Task

from casper.engine.domain.domain import Domain, build
from casper.kb.checks.finding import Finding, finding_of, note, sorted_findings, warning
from casper.kb.errors import CasperError, Place
from casper.kb.terms.syntax import atom_text
from casper.kb.text.files import write_texts
from casper.kb.text.reader import read_text
from casper.planning.importing.actions import action_lines, alike
from casper.planning.importing.alternatives import Unsaid
from casper.planning.importing.methods import impossible, method_lines, network_lines, search_lines, signature
from casper.planning.importing.names import outward
from casper.planning.importing.things import agent_lines, fluent_lines, initial_lines, object_lines, type_lines
from casper.planning.importing.vocabulary import ANYBODY, Vocabulary, Who

ONTOLOGY, PLANS = "ontology.pl", "plans.pl"
Where: TypeAlias = Callable[[str, str], Place]
"""(kind of thing, its name) -> where it is defined."""
MOMENTS = r"""
% What holds at a moment: the event calculus. T is the time of something that happened, or now: after everything.
holds(F, T) :- initially(F), \+ ended(F, T).
holds(F, T) :- earlier(S, P, T), initiates(S, F, P), \+ ended_since(P, F, T).
ended(F, T) :- earlier(S, P, T), terminates(S, F, P).
ended_since(P, F, T) :- earlier(S, Q, T), P < Q, terminates(S, F, Q).
value(F, V, T) :- initial_value(F, V), \+ changed(F, T).
value(F, V, T) :- earlier(S, P, T), changes(S, F, P), \+ changed_since(P, F, T), assigns(S, F, V, P).
changed(F, T) :- earlier(S, P, T), changes(S, F, P).
changed_since(P, F, T) :- earlier(S, Q, T), P < Q, changes(S, F, Q).
moment(now).
moment(T) :- did(_, T).
earlier(S, P, now) :- did(S, P).
earlier(S, P, T) :- did(S, P), did(_, T), P < T.
"""


class LeftOut(UserWarning):
    """Something of a problem is not in the domain that was made of it."""


@dataclass(frozen=True)
class Imported:
    """A problem as the texts of a domain, by file name; ``findings`` say what is not in them."""

    name: str
    files: Mapping[str, str]
    findings: Sequence[Finding] = field(default=())

    def domain(self) -> Domain:
        """The domain, without writing it.

        Raises:
            CasperError: the problem has plans that mean nothing, such as a task that can only go on for ever.
        """
        return build(self.name, Path(self.name), {name: read_text(text, name) for name, text in self.files.items()})

    def write(self, folder: Path, *, replace: bool = False) -> list[Finding]:
        """Write the texts, and look whether they can be loaded.

        Raises:
            DomainError: the folder has such files already, or cannot be written.
        """
        write_texts(folder, self.files, replace=replace)
        return sorted_findings([*self.findings, *_loaded(folder)])


def _loaded(folder: Path) -> Iterator[Finding]:
    try:
        Domain.load(folder)
    except CasperError as mistake:
        yield finding_of(mistake, Place(str(folder)))


def from_problem(
    problem: Problem, *, agent: str | None = None, partner: str | None = None, robot: str | None = None
) -> Domain:
    """A domain of a Unified Planning problem; whatever is not in it is told as a warning (`LeftOut`).

    Args:
        problem: with or without tasks and methods.
        agent: the type of those who act: the first parameter of that type does the action. None: the agent is added to
            every action.
        partner: who is watched (else the first object of that type, or ``human``).
        robot: who helps (else the next one, or ``robot``).

    Raises:
        CasperError: no such type, no problem of one kind of state, or plans that mean nothing.
    """
    imported = import_problem(problem, Who(agent, partner, robot))
    for finding in imported.findings:
        warnings.warn(str(finding), LeftOut, stacklevel=2)
    return imported.domain()


def import_problem(problem: Problem, who: Who = ANYBODY, where: Where | None = None) -> Imported:
    """The texts of a domain, and findings.

    Args:
        problem: the problem.
        who: who acts.
        where: where things are defined, for findings.

    Raises:
        CasperError: no such type of agents, or it is no problem of one kind of state.
    """
    if not isinstance(problem, Problem):
        raise CasperError(f"{type(problem).__name__} cannot be imported: a Problem or a HierarchicalProblem is needed")
    return _Import(Vocabulary(problem, who), where or (lambda kind, name: Place(f"problem {problem.name}"))).done()


class _Import:
    def __init__(self, vocabulary: Vocabulary, where: Where) -> None:
        self.vocabulary, self.problem, self.where = vocabulary, vocabulary.problem, where
        self.findings: list[Finding] = []
        self.left_out: set[str] = set()
        self.actions: list[Any] = []

    def done(self) -> Imported:
        """The texts."""
        name = str(self.problem.name or "problem")
        self._beyond()
        for fluent, reason in self.vocabulary.unsaid.items():
            self._refuse("fluent", fluent, reason)
        files = {ONTOLOGY: self._ontology(name), PLANS: self._plans()}
        files[ONTOLOGY] += "".join(f"% left out: {' '.join(finding.message.split())}\n" for finding in self.findings)
        return Imported(name, files, sorted_findings(self.findings))

    def _ontology(self, name: str) -> str:
        vocabulary = self.vocabulary
        told = f"% The problem {' '.join(name.split())}: what there is, what can be done, and what comes of it."
        sections = {
            "Types": type_lines(vocabulary),
            "Objects": object_lines(vocabulary),
            "Who is watched, who helps, and who acts": agent_lines(vocabulary),
            "What may be so": fluent_lines(vocabulary),
            "What is so at first": initial_lines(vocabulary),
            "What can be done, and what comes of it": self._actions(),
        }
        text = f"{told}\nproblem({atom_text(name)}).\n" + "".join(map(_section, sections, sections.values()))
        return text + MOMENTS + "".join(f":- dynamic {gap}.\n" for gap in _gaps(text))

    def _actions(self) -> Iterator[str]:
        for action in self.problem.actions:
            lines = self._tried("action", action.name, lambda action=action: action_lines(self.vocabulary, action))  # type: ignore[misc]
            if lines:
                self.actions.append(action)
                self.findings += [warning(self.where("action", action.name), told) for told in alike(action)]
                yield from lines

    def _plans(self) -> str:
        if not isinstance(self.problem, HierarchicalProblem):
            found = self._tried("goal", "", lambda: search_lines(self.vocabulary, self.actions)) or []
            return "".join(f"{line}\n" for line in found)
        return "".join(f"{line}\n" for line in self._hierarchy(self.problem))

    def _hierarchy(self, problem: Any) -> Iterator[str]:
        yield from (signature(task, self.vocabulary) for task in problem.tasks)
        yield from self._of_network("htn", "", problem.task_network, lambda: network_lines(self.vocabulary))
        done: set[str] = set()
        for method in problem.methods:
            lines = self._of_network(
                "method", method.name, method, lambda method=method: method_lines(self.vocabulary, method)  # type: ignore[misc]
            )
            if lines:
                done.add(method.achieved_task.task.name)
            yield from lines
        for task in problem.tasks:
            if task.name not in done:
                self.findings.append(warning(self.where("task", task.name), f"no method does the task {task.name}"))
                yield impossible(task)

    def _of_network(self, kind: str, name: str, network: Any, lines: Callable[[], list[str]]) -> list[str]:
        missing = [s.task.name for s in network.subtasks if not isinstance(s.task, Task) and s.task not in self.actions]
        if missing:
            self._refuse(kind, name, f"it needs the action {missing[0]}, which is left out")
            return []
        return self._tried(kind, name, lines) or []

    def _tried(self, kind: str, name: str, lines: Callable[[], list[str]]) -> list[str] | None:
        try:
            return lines()
        except Unsaid as mistake:
            self._refuse(kind, name, mistake.sentence)
            return None

    def _refuse(self, kind: str, name: str, reason: str) -> None:
        told = _KINDS.get(kind, f"the {kind} {name}")
        self.findings.append(warning(self.where(kind, name), f"{told} is left out: {reason}"))

    def _beyond(self) -> None:
        """Parts of a problem that no clause here says."""
        problem, place = self.problem, self.where("problem", "")
        if problem.trajectory_constraints:
            self.findings.append(warning(place, "constraints on the course of states are left out"))
        if problem.timed_goals or problem.timed_effects:
            told = "goals and effects at given times are left out: actions here take no time"
            self.findings.append(warning(place, told))
        for metric in problem.quality_metrics:
            self.findings.append(note(place, f"the metric ({metric}) is left out: plans here have no costs"))
        for kind in ("processes", "events"):
            for each in getattr(problem, kind, ()):
                told = f"{each.name} of the {kind} is left out: nothing happens by itself"
                self.findings.append(warning(place, told))
        for action in problem.actions:
            if outward(action.name) in {outward(task.name) for task in getattr(problem, "tasks", ())}:
                said = f"{action.name} is an action and a task; rename one of them"
                raise CasperError(said, self.where("action", action.name))


_KINDS = {"htn": "the initial task network", "goal": "the state that is wanted"}


def _section(title: str, lines: Iterator[str]) -> str:
    found = list(lines)
    return f"\n% {title}\n" + "".join(f"{line}\n" for line in found) if found else ""


def _gaps(text: str) -> Iterator[str]:
    """Relations of the event calculus that nothing defines in this problem."""
    for name, arity in (("initiates", 3), ("terminates", 3), ("changes", 3), ("assigns", 4), ("fluent", 2)):
        if f"\n{name}(" not in text:
            yield f"{name}/{arity}"
