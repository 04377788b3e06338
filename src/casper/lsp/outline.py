"""The outline of a text: goals and tasks with their steps, predicates with their clauses."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field

from casper.lsp.documents import Document
from casper.lsp.names import Name


@dataclass
class Part:
    """An entry: what it is called, of which kind, where it stands, and what is under it."""

    name: str
    kind: str  # "task", "step", "predicate", "constraint"
    start: int
    end: int
    parts: list[Part] = field(default_factory=list)


def outline(doc: Document) -> list[Part]:
    """The entries in the order of the text; clauses of one predicate that follow one another are one entry."""
    found: list[Part] = []
    for start, piece in doc.pieces:
        head = next((n for n in piece.names if n.role in ("head", "plan")), None)
        if head is None:
            continue
        end = start + len(piece.text)
        if head.role == "plan":
            found.append(Part(_signature(head.name, head.arity), "task", start, end, list(_steps(start, piece.names))))
            continue
        kind = "constraint" if head.name == "never" else "predicate"
        name = _constraint(piece.text) if kind == "constraint" else _signature(head.name, head.arity)
        if found and found[-1].name == name and kind == "predicate":
            found[-1].end = end
        else:
            found.append(Part(name, kind, start, end))
    return found


def _steps(start: int, names: tuple[Name, ...]) -> Iterator[Part]:
    for name in names:
        if name.role == "step" and name.name not in ("optional", "unordered", "steps", "repeat", "by"):
            yield Part(_signature(name.name, name.arity), "step", start + name.start, start + name.end)


def _signature(name: str, arity: int | None) -> str:
    return name if arity is None else f"{name}/{arity}"


def _constraint(text: str) -> str:
    """The sentence of a constraint, as it is written."""
    inner = text.partition("(")[2].lstrip()
    return inner[1:].partition(inner[:1])[0] or "never" if inner[:1] in "'\"" and inner else "never"
