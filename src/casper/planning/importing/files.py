"""Files of PDDL and HDDL as a problem of Unified Planning, with the places of what they define.

The framework's reader leaves out the constraints of methods; they are read here. Names that are used twice are let
through while it reads: 31 of the 33 domains of the competition of 2020 can be read so, and 28 otherwise.
"""

from __future__ import annotations

import re
import warnings
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from unified_planning.environment import get_environment
from unified_planning.io import PDDLReader
from unified_planning.model import Problem

from casper.kb.errors import DomainError, Place, ReadError
from casper.kb.text.files import read_utf8
from casper.planning.importing.brackets import Node, read_brackets
from casper.planning.importing.importing import Imported, import_problem
from casper.planning.importing.vocabulary import ANYBODY, Who

_SECTIONS = {":predicates": "fluent", ":functions": "fluent"}


@dataclass(frozen=True)
class Source:
    """A file's text, and what is defined in it."""

    path: Path
    text: str
    node: Node

    @property
    def kind(self) -> str:
        """``domain`` or ``problem``."""
        return self.node.items[1].head if len(self.node.items) > 1 else ""


def import_files(files: Sequence[Path], who: Who = ANYBODY) -> Imported:
    """A domain file, and a problem file or none, as the texts of a domain.

    Raises:
        DomainError: a file that cannot be read, or other files than these.
        ReadError: what is not PDDL or HDDL, or what the framework cannot read, with file and line.
        CasperError: as `import_problem`.
    """
    sources = [_source(file) for file in files]
    domains = [source for source in sources if source.kind == "domain"]
    problems = [source for source in sources if source.kind == "problem"]
    for source in sources:
        if source.kind not in ("domain", "problem"):
            needed = "a file of planning begins with (define (domain …) or (define (problem …)"
            raise ReadError(needed, source.node.place)
    if len(domains) != 1 or len(problems) > 1:
        told = f"these are {len(domains)} domains and {len(problems)} problems"
        raise DomainError(f"{told}: give the file of one domain, and the file of one problem or none")
    problem = _read(domains[0], problems[0] if problems else None)
    _constrain(problem, domains[0].node)
    places = {key: place for source in sources for key, place in _places(source.node)}
    whole = Place(str(sources[-1].path), 1)
    return import_problem(problem, who, lambda kind, name: places.get((kind, name.lower()), whole))


def _source(path: Path) -> Source:
    try:
        text = read_utf8(path)
    except OSError as mistake:
        raise DomainError(f"cannot read {path} ({mistake})") from None
    return Source(path, text, read_brackets(text, str(path)))


def _read(domain: Source, problem: Source | None) -> Problem:
    try:
        return _parsed(domain, problem)
    except Exception as found:  # the framework has no class of its own for what it cannot read
        mistake, blamed = found, domain
        if problem is not None:
            try:
                _parsed(domain, None)
                blamed = problem
            except Exception as first:
                mistake = first
        raise ReadError(*_told(mistake, blamed)) from None


def _parsed(domain: Source, problem: Source | None) -> Problem:
    with lenient_names(), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return PDDLReader().parse_problem_string(domain.text, problem.text if problem is not None else None)


@contextmanager
def lenient_names() -> Iterator[None]:
    """Names that are used twice are no mistake meanwhile; the framework has one setting for all its users."""
    environment = get_environment()
    before = environment.error_used_name
    environment.error_used_name = False
    try:
        with warnings.catch_warnings():
            warnings.filterwarnings("ignore", module="unified_planning")
            yield
    finally:
        environment.error_used_name = before


def _told(mistake: Exception, source: Source) -> tuple[str, Place]:
    """What the framework says in one sentence, and where."""
    said = " ".join(str(mistake).split()) or "no reason is given"
    found = re.search(r"[Ll]ine:?\s*(\d+)", said)
    line = int(found[1]) if found else getattr(mistake, "lineno", None) or 0
    if isinstance(mistake, KeyError):
        name = str(mistake.args[0])
        said = f"{name} is not declared"
        line = line or _line_of(name, source)
    said = re.sub(r"[.,]?\s*(Error\s*)?([Ff]rom\s*)?[Ll]ine:? ?\d+.*$", "", said).rstrip(" .,")
    said = re.sub(r"^\w+(?:Error|Exception)\(([\"'])(.*)\1\)$", r"\2", said)  # one exception in another
    wanted = source.node.items[2] if len(source.node.items) > 2 else None
    is_told = wanted is not None and wanted.head == ":requirements"
    needs = f" (it requires {' '.join(map(str, wanted.items[1:]))})" if wanted and is_told else ""
    return f"Unified Planning cannot read this: {said}{needs}", Place(str(source.path), line)


def _line_of(name: str, source: Source) -> int:
    found = re.search(rf"(?<![\w-]){re.escape(name)}(?![\w-])", source.text, re.IGNORECASE)
    return source.text.count("\n", 0, found.start()) + 1 if found else 0


def _places(node: Node) -> Iterator[tuple[tuple[str, str], Place]]:
    yield ("problem", ""), node.place
    for part in node.items[2:]:
        kind = part.head.removeprefix(":").removeprefix("durative-")
        if part.head in _SECTIONS:
            yield from ((("fluent", each.head), each.place) for each in part.items[1:] if each.items)
        elif kind in ("htn", "goal"):
            yield (kind, ""), part.place
        elif len(part.items) > 1:
            yield (kind, part.items[1].word), part.place


def _constrain(problem: Any, domain: Node) -> None:
    """Add the constraints of methods, which the framework's reader passes over."""
    for part in domain.items[2:]:
        constraints = part.after(":constraints") if part.head == ":method" else None
        if constraints is not None and constraints.items:
            method = problem.method(part.items[1].word)
            method.add_constraint(_constraint(problem, method, constraints))


def _constraint(problem: Any, method: Any, node: Node) -> Any:
    manager = problem.environment.expression_manager
    inner = [_constraint(problem, method, item) for item in node.items[1:]] if node.head in _CONNECTIVES else []
    if node.head in _CONNECTIVES:
        return getattr(manager, _CONNECTIVES[node.head])(*inner)
    if node.head == "=" and len(node.items) == 3:
        return manager.Equals(*(_named(problem, method, item) for item in node.items[1:]))
    raise ReadError(f"{node} is no constraint: write =, not, and, or of parameters and objects", node.place)


_CONNECTIVES = {"and": "And", "or": "Or", "not": "Not", "imply": "Implies"}


def _named(problem: Any, method: Any, node: Node) -> Any:
    manager = problem.environment.expression_manager
    try:
        if node.word.startswith("?"):
            return manager.ParameterExp(method.parameter(node.word[1:]))
        return manager.ObjectExp(problem.object(node.word))
    except Exception:
        raise ReadError(f"the method {method.name} has no {node}", node.place) from None
