"""PDDL's brackets with their places: what stands where, for findings, and for what Unified Planning does not read."""

from __future__ import annotations

import re
from collections.abc import Iterator
from dataclasses import dataclass

from casper.kb.errors import Place, ReadError

_TOKEN = re.compile(r";[^\n]*|[()]|[^\s();]+")


@dataclass(frozen=True)
class Node:
    """A word, in small letters, or a list of nodes (then ``word`` is empty)."""

    word: str
    items: tuple[Node, ...]
    place: Place

    @property
    def head(self) -> str:
        """The first word of a list."""
        return self.items[0].word if self.items else ""

    def after(self, key: str) -> Node | None:
        """What follows a key such as ``:constraints``."""
        for at, item in enumerate(self.items[:-1]):
            if item.word == key:
                return self.items[at + 1]
        return None

    def __str__(self) -> str:
        return self.word or f"({' '.join(map(str, self.items))})"


def read_brackets(text: str, file: str) -> Node:
    """The one list that a text is.

    Raises:
        ReadError: brackets that do not close, or nothing at all.
    """
    open_: list[tuple[Place, list[Node]]] = []
    for token, place in _tokens(text, file):
        if token == "(":
            open_.append((place, []))
        elif token == ")":
            if not open_:
                raise ReadError("this bracket closes nothing; take it out", place)
            begun, items = open_.pop()
            node = Node("", tuple(items), begun)
            if not open_:
                return node
            open_[-1][1].append(node)
        elif open_:
            open_[-1][1].append(Node(token.lower(), (), place))
        else:
            raise ReadError(f"a definition in brackets is needed here, not {token}", place)
    if open_:
        raise ReadError("this bracket is never closed; write ) at its end", open_[0][0])
    raise ReadError("there is nothing in this file; (define (domain …) …) is needed", Place(file))


def _tokens(text: str, file: str) -> Iterator[tuple[str, Place]]:
    line, begin, seen = 1, 0, 0
    for found in _TOKEN.finditer(text):
        if found[0][0] == ";":
            continue
        gap = text.count("\n", seen, found.start())
        if gap:
            line += gap
            begin = text.rfind("\n", 0, found.start()) + 1
        seen = found.start()
        yield found[0], Place(file, line, found.start() - begin + 1)
