"""The names of a sentence: which stand where, in which role. Made of tokens, so half a sentence has names, too."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Literal, TypeAlias

from casper.kb.terms.atoms import is_signs
from casper.kb.terms.operators import STANDARD
from casper.kb.terms.syntax import COMPARISONS
from casper.kb.text.parsing.tokens import NAME, PUNCTUATION, QUOTED, VARIABLE, Tokens, Unreadable, unquoted

Role: TypeAlias = Literal["head", "condition", "plan", "step", "data", "variable"]
"""A clause's head, a condition or a statement, the head of a production, a step or task of a plan, an argument."""

_STATEMENTS = frozenset(
    {"claim", "did", "valid", "say", "example", "call", "not", "findall", "forall", "aggregate_all"}
)
_SHAPES = frozenset({"optional", "unordered", "steps", "repeat", "by"})
_OPENING, _CLOSING = "([{", ")]}"


@dataclass(frozen=True, slots=True)
class Name:
    """A name with its place in the sentence's text.

    ``arity`` is None for a constant and a variable; ``within`` is the functor whose argument it is ('' for none), and
    ``number`` which one, from 0.
    """

    name: str
    arity: int | None
    role: Role
    start: int
    end: int
    within: str = ""
    number: int = 0


@dataclass(slots=True)
class _Frame:
    """An open bracket: the name before it, which argument is being read, and what role names have within."""

    functor: int | None  # its number among the names
    name: str
    role: Role
    argument: int = 0
    is_empty: bool = True


def names_of(tokens: Tokens) -> list[Name]:
    """The names of one sentence, in order, with offsets from its start."""
    reader = _Reader(tokens)
    return reader.read()


class _Reader:
    def __init__(self, tokens: Tokens) -> None:
        self.tokens = tokens
        self.base = tokens.starts[0] if tokens.starts else 0
        self.names: list[Name] = []
        self.frames: list[_Frame] = []
        self.section: Role = "head"

    def read(self) -> list[Name]:
        """Take the tokens one by one."""
        for at, (kind, word) in enumerate(zip(self.tokens.kinds, self.tokens.texts)):
            if word in ("", ":-", "-->") or kind == PUNCTUATION:
                self._structure(at, kind, word)
                continue
            if self.frames:
                self.frames[-1].is_empty = False
            if kind == VARIABLE:
                if word != "_":
                    self._add(word, None, "variable", at)
            elif kind in (NAME, QUOTED):
                self._name(at, kind, word)
        while self.frames:
            self._close()
        return self.names

    def _structure(self, at: int, kind: str, word: str) -> None:
        if word == ":-" and not self.frames:
            self.section = "condition" if at else "data"
        elif word == "-->" and not self.frames:
            self.section = "step"
            self.names = [replace(n, role="plan") if n.role == "head" else n for n in self.names]
        elif kind == PUNCTUATION and word in _OPENING:
            if not (word == "(" and self._follows_name(at)):
                role = self._role()
                self.frames.append(_Frame(None, "", "condition" if word == "{" and role == "step" else role))
        elif kind == PUNCTUATION and word in _CLOSING and self.frames:
            self._close()
        elif word == "," and self.frames:
            self.frames[-1].argument += 1

    def _follows_name(self, at: int) -> bool:
        return (
            at > 0
            and bool(self.frames)
            and self.frames[-1].functor is not None
            and self.frames[-1].is_empty
            and (self.tokens.kinds[at - 1] in (NAME, QUOTED) and self.tokens.end(at - 1) == self.tokens.starts[at])
        )

    def _name(self, at: int, kind: str, word: str) -> None:
        name = word
        if kind == QUOTED:
            try:
                name = unquoted(word)
            except Unreadable:
                return
        is_called = self.tokens.texts[at + 1] == "(" and self.tokens.starts[at + 1] == self.tokens.end(at)
        if not is_called and kind == NAME and (is_signs(word) or word in STANDARD or word in "!;|"):
            return
        role = self._role()
        if is_called:
            self._add(name, 0, role, at)
            self.frames.append(_Frame(len(self.names) - 1, name, self._inner(name, role)))
        elif role in ("condition", "step", "head") and not self._is_compared(at) and self.section != "data":
            self._add(name, 0, role, at)
        else:
            self._add(name, None, "data", at)

    def _is_compared(self, at: int) -> bool:
        """Whether a name is a side of a comparison, or an operand: then it is a constant."""
        around = [self.tokens.texts[at + 1], *([self.tokens.texts[at - 1]] if at else [])]
        return any(word in COMPARISONS or word in ("+", "-", "*", "/", ":") for word in around)

    def _inner(self, name: str, role: Role) -> Role:
        """The role of what stands in the brackets of a name."""
        if name in _STATEMENTS and role in ("head", "condition"):
            return "condition"
        if role == "head" and name == "goal":
            return "step"
        return "step" if role == "step" and name in _SHAPES else "data"

    def _role(self) -> Role:
        if not self.frames:
            return self.section
        frame = self.frames[-1]
        first_is_data = frame.name in ("by", "findall", "aggregate_all") and frame.argument == 0
        return "data" if first_is_data else frame.role

    def _add(self, name: str, arity: int | None, role: Role, at: int) -> None:
        frame = next((f for f in reversed(self.frames) if f.functor is not None), None)
        start, end = self.tokens.starts[at] - self.base, self.tokens.end(at) - self.base
        within, number = ("", 0) if frame is None else (frame.name, frame.argument)
        if role != "data" and frame is not None and arity == 0 and self.frames[-1].functor is not None:
            called = self.tokens.texts[at + 1] == "("
            if not called and frame.name in ("say", "example", "did") and role == "condition":
                arity, role = None, "data"  # a thing, a language, a time
        self.names.append(Name(name, arity, role, start, end, within, number))

    def _close(self) -> None:
        frame = self.frames.pop()
        if frame.functor is not None:
            arity = 0 if frame.is_empty else frame.argument + 1
            self.names[frame.functor] = replace(self.names[frame.functor], arity=arity)
        if self.frames:
            self.frames[-1].is_empty = False
