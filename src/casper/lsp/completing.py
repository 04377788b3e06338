"""What may stand where one types: predicates, tasks, things, variables of the clause, settings with their defaults."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Literal

from casper.engine.domain.relations import SECTIONS
from casper.kb.terms.atoms import is_word
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import SYSTEM
from casper.kb.terms.syntax import atom_text
from casper.lsp.documents import Document
from casper.lsp.names import Name
from casper.lsp.settings import settings
from casper.lsp.telling import comment_of
from casper.lsp.workspace import Domain, Symbol

MOST_SHOWN = 200
Kind = Literal["predicate", "task", "action", "thing", "variable", "setting", "word", "built-in"]
_TYPED = re.compile(r"\w*\Z")
_SETTING = re.compile(r"setting\(\s*(?:(\w+)\s*,\s*)?(\w*)\Z")
_SHAPES = ("optional", "unordered", "steps", "repeat", "by")
_WORDS = ("never", "goal", "setting", "say", "prior")


@dataclass(frozen=True, slots=True)
class Proposal:
    """What may be typed: its text, what kind it is, a word beside it, and the symbol to say more about."""

    text: str
    kind: Kind
    detail: str = ""
    about: str = ""


def proposals(domain: Domain, doc: Document, offset: int) -> list[Proposal]:
    """What may stand at an offset, those that begin as what is typed there."""
    before = doc.text[max(0, offset - 2000) : offset]
    typed = _TYPED.search(before)
    word = typed[0] if typed is not None else ""
    asked = _SETTING.search(before)
    if asked is not None:
        found = _settings(asked[1], asked[2])
    elif _in_comment(before):
        return []
    else:
        found = _names(domain, doc, offset, before[: len(before) - len(word)], word)
    fitting = {p.text: p for p in found if p.text.lower().startswith(word.lower()) and p.text != word}
    return list(fitting.values())[:MOST_SHOWN]


def _in_comment(before: str) -> bool:
    line = before.rpartition("\n")[2]
    return "%" in line and line.count('"', 0, line.index("%")) % 2 == 0


def _settings(section: str | None, typed: str) -> Iterator[Proposal]:
    if section is None:
        yield from (Proposal(each, "setting", "a stage") for each in SECTIONS)
        return
    for each in settings():
        if each.section == section:
            yield Proposal(each.name, "setting", f"default {each.default}" if each.default else "", each.about)


def _names(domain: Domain, doc: Document, offset: int, before: str, word: str) -> Iterator[Proposal]:
    if word[:1].isupper() or word.startswith("_"):
        yield from _variables(doc, offset)
        return
    within = _open_bracket(before)
    in_plan = _last_arrow(before) == "-->"
    if within and within not in (*_SHAPES, "claim", "did", "valid", "say"):
        yield from _things(domain)
        yield from _variables(doc, offset)
        return
    if in_plan:
        yield from (Proposal(n, "task", f"{n}/{a}") for n, a in sorted(domain.tasks))
        yield from _actions(domain, word)
        yield from (Proposal(shape, "word", "shape of plans") for shape in _SHAPES)
        return
    yield from _predicates(domain, word)
    yield from (Proposal(each, "word") for each in _WORDS)
    yield from (Proposal(n, "built-in", f"{n}/{a}") for n, a in sorted(BUILTINS) if is_word(n))
    yield from (Proposal(n, "built-in", f"{n}/{a}, the system's") for n, a in SYSTEM)
    if within:
        yield from _things(domain)


def _predicates(domain: Domain, word: str) -> Iterator[Proposal]:
    for name, arity in _defined(domain, word):
        yield Proposal(atom_text(name), "predicate", f"{name}/{arity}", _comment(domain, (name, arity)))


def _actions(domain: Domain, word: str) -> Iterator[Proposal]:
    """Predicates that may be actions: with the agent left out they are steps."""
    for name, arity in _defined(domain, word):
        if arity > 1:
            yield Proposal(atom_text(name), "action", f"{name}/{arity - 1}", _comment(domain, (name, arity)))


def _defined(domain: Domain, word: str) -> list[tuple[str, int]]:
    """The predicates that begin so, as many as are shown: what is said of each is looked up."""
    return sorted(each for each in domain.defined if each[0].lower().startswith(word.lower()))[:MOST_SHOWN]


def _things(domain: Domain) -> Iterator[Proposal]:
    for (name, arity), uses in domain.uses.items():
        if arity is None and any(not use.doc.text.startswith(('"', "'"), use.start) for use in uses):
            classes = dict.fromkeys(use.name.within for use in uses if use.name.within)
            yield Proposal(atom_text(name), "thing", ", ".join(list(classes)[:4]))


def _variables(doc: Document, offset: int) -> Iterator[Proposal]:
    found = doc.piece_at(offset)
    names: tuple[Name, ...] = () if found is None else found[1].names
    yield from (Proposal(n, "variable") for n in dict.fromkeys(x.name for x in names if x.role == "variable"))


def _comment(domain: Domain, symbol: Symbol) -> str:
    first = next(iter(domain.definitions(symbol)), None)
    piece = None if first is None else first.doc.piece_at(first.start)
    return "" if first is None or piece is None else comment_of(first.doc, piece[0])


def _open_bracket(before: str) -> str:
    """The name in front of the innermost bracket that is open; empty where there is none in this clause."""
    depth = 0
    for at in range(len(before) - 1, -1, -1):
        character = before[at]
        if character in ")]}":
            depth += 1
        elif character in "([{":
            if depth == 0:
                name = re.search(r"\w+\Z", before[:at])
                return name[0] if character == "(" and name is not None else "" if character != "[" else "["
            depth -= 1
        elif character == "." and before[at + 1 : at + 2].isspace() and depth == 0:
            return ""
    return ""


def _last_arrow(before: str) -> str:
    clause = re.split(r"\.\s", before)[-1]
    found = re.findall(r":-|-->", clause)
    return found[-1] if found else ""
