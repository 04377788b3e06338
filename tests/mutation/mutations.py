"""Mutants: small faults that can be planted in a Python file. Knows the syntax only, and of no tests."""

from __future__ import annotations

import ast
import random
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TypeAlias

Change: TypeAlias = tuple[ast.AST, ast.AST]  # a part of the program, and what becomes of it

SKIPPED = ("annotation", "returns", "decorator_list")  # what a type checker judges, not a test
_OPPOSITES = [(ast.Eq, ast.NotEq), (ast.Is, ast.IsNot), (ast.In, ast.NotIn)]
_SWAPS = [
    *_OPPOSITES,
    *[(ast.Lt, ast.LtE), (ast.Gt, ast.GtE), (ast.And, ast.Or), (ast.BitAnd, ast.BitOr)],
    *[(ast.Add, ast.Sub), (ast.Mult, ast.Div), (ast.FloorDiv, ast.Mod)],
]
OTHER = {a: b for a, b in _SWAPS} | {b: a for a, b in _SWAPS}
_OPPOSITE = {kind for pair in _OPPOSITES for kind in pair}


@dataclass(frozen=True)
class Mutant:
    """One change of one file: its bytes from ``start`` to ``end`` become ``after``."""

    path: str
    line: int
    start: int
    end: int
    before: str
    after: str

    def planted(self, source: bytes) -> bytes:
        """The file with the change in it."""
        return source[: self.start] + self.after.encode() + source[self.end :]

    def __str__(self) -> str:
        before, after = (" ".join(text.split()) for text in (self.before, self.after))
        return f"{self.path}:{self.line}: {before} → {after}"


def sample(root: Path, place: str, count: int, seed: int, leave: Sequence[str] = ()) -> list[Mutant]:
    """Some of the mutants of a package, folder or file, in the order of the text; none of what is to be left out."""
    paths = [root / place] if (root / place).is_file() else sorted((root / place).rglob("*.py"))
    names = [path.relative_to(root).as_posix() for path in paths]
    kept = [name for name in names if not any(f"{name}/".startswith(f"{left}/") for left in leave)]
    found = [mutant for name in kept for mutant in mutants_of((root / name).read_bytes(), name)]
    chosen = random.Random(seed).sample(range(len(found)), min(count, len(found)))
    return [found[number] for number in sorted(chosen)]


def mutants_of(source: bytes, path: str) -> list[Mutant]:
    """Every mutant of a file, in the order of its text."""
    begins = [0]
    for line in source.splitlines(keepends=True):
        begins.append(begins[-1] + len(line))
    found = []
    for node in _nodes(ast.parse(source)):
        for old, new in _changes(node):
            start, end = begins[old.lineno - 1] + old.col_offset, begins[old.end_lineno - 1] + old.end_col_offset
            after = ast.unparse(new) if isinstance(new, ast.stmt) else f"({ast.unparse(new)})"
            found.append(Mutant(path, old.lineno, start, end, source[start:end].decode(), after))
    return sorted(dict.fromkeys(found), key=lambda mutant: (mutant.start, mutant.end))


def _nodes(node: ast.AST) -> Iterator[ast.AST]:
    """The parts of a program that do something; not those in f-strings, whose places Python 3.11 tells wrongly."""
    yield node
    if isinstance(node, ast.JoinedStr):
        return
    for name, value in ast.iter_fields(node):
        for child in value if isinstance(value, list) else [value]:
            if isinstance(child, ast.AST) and name not in SKIPPED:
                yield from _nodes(child)


def _changes(node: ast.AST) -> Iterator[Change]:
    yield from _changed_expression(node) if isinstance(node, ast.expr) else _changed_statement(node)


def _changed_expression(node: ast.AST) -> Iterator[Change]:
    match node:
        case ast.Compare(left, [op, *ops], rest) if type(op) in OTHER:
            yield node, ast.Compare(left, [OTHER[type(op)](), *ops], rest)
        case ast.BinOp(left, op, right) if type(op) in OTHER:
            yield node, ast.BinOp(left, OTHER[type(op)](), right)
        case ast.BoolOp(op, values):
            yield node, ast.BoolOp(OTHER[type(op)](), values)
        case ast.Constant(bool() as value):
            yield node, ast.Constant(not value)
        case ast.Constant(int() | float() as value):
            yield from ((node, ast.Constant(value + step)) for step in (1, -1))
        case ast.UnaryOp(ast.Not() | ast.USub(), operand):
            yield node, operand
        case ast.IfExp(test):
            yield from _negated(test)


def _changed_statement(node: ast.AST) -> Iterator[Change]:
    match node:
        case ast.If(test) | ast.While(test):
            yield from _negated(test)
        case ast.comprehension(_, _, tests):
            yield from (change for test in tests for change in _negated(test))
        case ast.Return(ast.expr() as value) if ast.unparse(value) != "None":
            yield node, ast.Return(ast.Constant(None))
        case ast.Break():
            yield node, ast.Continue()
        case ast.Continue():
            yield node, ast.Break()
        case ast.Expr(value) if not isinstance(value, ast.Constant):
            yield node, ast.Pass()
        case ast.AugAssign() | ast.Delete() | ast.Raise() | ast.Assign([ast.Attribute() | ast.Subscript()]):
            yield node, ast.Pass()


def _negated(test: ast.expr) -> Iterator[Change]:
    """A condition with ``not`` in front, unless another change says the same."""
    same = isinstance(test, ast.Compare) and len(test.ops) == 1 and type(test.ops[0]) in _OPPOSITE
    if not same and not isinstance(test, ast.UnaryOp) and ast.unparse(test) != "TYPE_CHECKING":
        yield test, ast.UnaryOp(ast.Not(), test)
