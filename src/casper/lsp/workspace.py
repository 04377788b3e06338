"""All texts of a domain as they are in the editor, and on disk where they are not open there."""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import TypeAlias

from casper.engine.domain.domain import FILES, SHIPPED
from casper.engine.domain.examples import TESTS
from casper.engine.domain.relations import SYSTEM_RELATIONS
from casper.kb.checks.finding import Finding, error
from casper.kb.errors import Place
from casper.kb.reasons.says import SAYS, Say, is_say, say_of
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM, Clause, Directive, Indicator, Production
from casper.kb.terms.control import CONTROL
from casper.kb.text.files import read_utf8
from casper.lsp.documents import Document, document
from casper.lsp.names import Name
from casper.plans.library import GOAL
from casper.plans.relations import RELATIONS

MOST_FILES = 100  # of a domain
_NAMING = {"context": 2, "transition": 0, "cycle": 0, "loop": 0, "start": 0, "consumes": 0}
"""Facts that name an action, and in which argument (from 0)."""
Symbol: TypeAlias = tuple[str, int | None]
"""What a name stands for: a predicate, task or action by name and arity; a constant has None."""


@dataclass(frozen=True)
class Use:
    """A name in a text, with its offsets there."""

    doc: Document
    name: Name
    start: int
    end: int


@dataclass
class Domain:
    """The texts of one folder, or one text alone, and an index of their names."""

    folder: Path
    docs: tuple[Document, ...]
    findings: tuple[Finding, ...] = ()  # files that cannot be read
    prefixes: frozenset[str] = frozenset()
    lost: bool = False  # whether a file that should be part of it could not be read
    is_domain: bool = True

    @cached_property
    def uses(self) -> dict[Symbol, list[Use]]:
        """Every use of every name, in the order of the texts."""
        found: dict[Symbol, list[Use]] = defaultdict(list)
        for doc in self.docs:
            for start, name in doc.names():
                if name.role != "variable":
                    found[self.symbol(name)].append(Use(doc, name, start + name.start, start + name.end))
        return found

    @cached_property
    def defined(self) -> frozenset[Indicator]:
        """The predicates that some clause or declaration defines."""
        return frozenset(each for doc in self.docs for _, piece in doc.pieces for each in piece.defines)

    @cached_property
    def tasks(self) -> frozenset[Indicator]:
        """The goals and tasks that have productions."""
        return frozenset(p.head.indicator for p in self.productions)

    @cached_property
    def productions(self) -> tuple[Production, ...]:
        """All of them."""
        found = (s for doc in self.docs for _, piece in doc.pieces for s in piece.sentences)
        return tuple(s for s in found if isinstance(s, Production))

    @cached_property
    def known(self) -> frozenset[Indicator]:
        """The predicates that a condition may ask."""
        given: Iterable[Indicator] = (*RELATIONS, GOAL) if self.productions else ()
        return self.defined | {*given, *SYSTEM, *BUILTINS, *CONTROL}

    @cached_property
    def half_read(self) -> frozenset[str]:
        """Names of clauses that could not be read: nobody knows what they would have defined."""
        half = (piece for doc in self.docs for _, piece in doc.pieces if piece.is_half_read)
        return frozenset(name.name for piece in half for name in piece.names[:1])

    @cached_property
    def says(self) -> tuple[Say, ...]:
        """The sentences of authors."""
        found = (s for doc in self.docs for _, piece in doc.pieces for s in piece.sentences)
        says = (say_of(s) for s in found if isinstance(s, Clause) and is_say(s))
        return tuple(say for say in says if say is not None)

    def symbol(self, name: Name) -> Symbol:
        """What a name stands for: a step of a plan is the action with its agent, where there is one."""
        if name.arity is None:
            return self._recognised(name)
        if name.role == "step" and (name.name, name.arity) not in self.tasks:
            return name.name, name.arity + 1
        if name.role == "condition" and name.within == "say" and (name.name, name.arity) not in self.defined:
            return self._worded(name.name, name.arity)
        return name.name, name.arity

    def _recognised(self, name: Name) -> Symbol:
        """What a constant stands for: facts that recognise or place actions name them."""
        if _NAMING.get(name.within) == name.number:
            arities = [arity for other, arity in self.defined if other == name.name and arity > 1]
            if arities:
                return name.name, max(arities)
        return name.name, None

    def _worded(self, name: str, arity: int) -> Symbol:
        """What a sentence is about: a step without its agent is worded, too."""
        is_step = (name, arity) not in self.tasks and (name, arity + 1) in self.defined
        return (name, arity + 1) if is_step else (name, arity)

    def is_system(self, symbol: Symbol) -> bool:
        """Whether the system gives it a meaning, so that it keeps its name."""
        return (
            symbol in BUILTINS
            or symbol in CONTROL
            or symbol in (*SYSTEM, *SAYS, GOAL)
            or (symbol in SYSTEM_RELATIONS or symbol in RELATIONS)
        )

    def is_foreign(self, doc: Document) -> bool:
        """Whether a text is one of the package's own, which other domains include as well."""
        return doc.path.is_relative_to(SHIPPED) and not doc.path.is_relative_to(self.folder)

    def definitions(self, symbol: Symbol) -> list[Use]:
        """Where something is defined: heads of clauses and productions; of a constant where it stands first."""
        uses = self.uses.get(symbol, [])
        if symbol[1] is None:
            return uses[:1]
        return [use for use in uses if use.name.role in ("head", "plan")]


@dataclass
class Workspace:
    """The texts that are open, and those on disk beside them."""

    open: dict[Path, str] = field(default_factory=dict)
    encoding: str = "utf-16"
    _kept: dict[Path, tuple[object, Document]] = field(default_factory=dict)
    _domains: dict[Path, Domain] = field(default_factory=dict)

    def domain_of(self, path: Path) -> Domain:
        """The domain that a text belongs to: its folder where that is one, otherwise the text alone."""
        folder = path.parent
        files = [folder / name for name in (*FILES, TESTS)]
        present = [file for file in files if file in self.open or os.path.lexists(file)]
        if path in files:
            return self._domain(folder, present)
        whole = self._domain(folder, present) if present else None
        if whole is not None and any(doc.path == path for doc in whole.docs):  # it is included
            return whole
        return self._domain(folder, [path], is_domain=False)

    def _domain(self, folder: Path, files: Iterable[Path], is_domain: bool = True) -> Domain:
        docs: dict[Path, Document] = {}
        findings: list[Finding] = []
        prefixes: set[str] = set()
        waiting, lost = list(files), False
        while waiting and len(docs) < MOST_FILES:
            file = waiting.pop(0)
            if file in docs:
                continue
            try:
                doc = docs[file] = self.document(file)
            except (OSError, ValueError) as mistake:
                lost = True
                findings.append(error(Place(str(file)), f"this file cannot be read ({mistake})"))
                continue
            for directive in _directives(doc):
                prefixes.update(_prefix(directive))
                waiting += _included(directive, file.parent)
        made = Domain(folder, tuple(docs.values()), tuple(findings), frozenset(prefixes), lost, is_domain)
        kept = self._domains.get(folder)
        if kept is not None and made == kept:  # with its index
            return kept
        self._domains[folder] = made
        return made

    def document(self, path: Path) -> Document:
        """A text, analysed; as it is in the editor, or else on disk.

        Raises:
            OSError: it cannot be read, or is no UTF-8.
        """
        text = self.open.get(path)
        stamp: object = text
        if text is None:
            seen = os.stat(path)
            stamp = (seen.st_mtime_ns, seen.st_size)
        kept = self._kept.get(path)
        if kept is None or kept[0] != stamp:
            kept = self._kept[path] = (stamp, document(path, read_utf8(path) if text is None else text, self.encoding))
        return kept[1]


def _directives(doc: Document) -> Iterator[Directive]:
    return (s for _, piece in doc.pieces for s in piece.sentences if isinstance(s, Directive))


def _prefix(directive: Directive) -> Iterator[str]:
    if directive.term.indicator == ("use", 2) and isinstance(directive.term[2], tuple):
        yield str(directive.term[2][-1])


def _included(directive: Directive, folder: Path) -> list[Path]:
    """The file that stands for an include, where there is one: beside the text, or among the shipped ones."""
    name = directive.term[1] if directive.term.indicator == ("include", 1) else None
    if not isinstance(name, str) or "\0" in name:
        return []
    places = (Path(os.path.normpath(above / name)) for above in (folder, SHIPPED))
    return [file for file in places if file.is_file()][:1]
