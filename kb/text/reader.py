"""The reader: text becomes clauses, productions and directives, or one sentence saying where it does not."""

from __future__ import annotations

import math
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from itertools import product
from pathlib import Path
from typing import Any

from lark import Lark, Token, Tree, UnexpectedInput
from lark.exceptions import UnexpectedCharacters, UnexpectedEOF

from casper.kb.errors import DomainError, Place, ReadError
from casper.kb.terms.clauses import Clause, Directive, Literal, Production, Sentence
from casper.kb.terms.control import CONTROL
from casper.kb.terms.terms import NIL, Compound, Term, Variable, make_list, predication
from casper.kb.terms.unification import variables_of
from casper.kb.text.bulk_reader import read_large
from casper.kb.text.namespace import qualified

LARGE = 20_000  # characters from which plain sentences are read by an expression of their own
_ESCAPES = {"n": "\n", "t": "\t", "\\": "\\", "'": "'", '"': '"', "0": "\0", "r": "\r"}
_NAMED = frozenset({"atom", "compound"})  # what a clause can be about
_CONDITIONS = _NAMED | {"compare", "colon"}
_EXPECTED = {
    "END": "a full stop",
    "RPAR": "')'",
    "RSQB": "']'",
    "COMMA": "','",
    "NAME": "a name",
    "VARIABLE": "a variable",
    "LPAR": "'('",
}


def read_text(text: str, file: str = "<text>") -> list[Sentence]:
    """Every sentence of the text, in order.

    Raises:
        ReadError: with file, line, column and a caret under the first thing that is not of the language.
    """
    if len(text) >= LARGE:
        return read_large(text, file, lambda part: _read_by_grammar(part, file))
    return _read_by_grammar(text, file)


def _read_by_grammar(text: str, file: str) -> list[Sentence]:
    tree = _parse(text, file, "start")
    with _excerpts(text):
        return [sentence for part in tree.children for sentence in _sentences(part, file)]


def read_file(path: Path) -> list[Sentence]:
    """Every sentence of a file.

    Raises:
        DomainError: the file cannot be read.
        ReadError: as `read_text`.
    """
    try:
        text = path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as mistake:
        raise DomainError(f"cannot read {path} ({mistake})") from None
    return read_text(text, str(path))


def read_query(text: str) -> tuple[tuple[Literal, ...], ...]:
    """The alternatives of a query such as ``eat(A, T, D), \\+ A = tiago``: each a conjunction of literals."""
    tree = _parse(text, "<query>", "query").children[0]
    with _excerpts(text):
        return tuple(tuple(body) for body in _alternatives(tree, "<query>", _Anonymous("<query>")))


def read_statement(text: str) -> Compound:
    """One atom, such as ``eat(human, biscuits, plate)``; variables and ``_`` are its unknown parts.

    Raises:
        ReadError: when the text is not a single atom.
    """
    alternatives = read_query(text)
    if len(alternatives) != 1 or len(alternatives[0]) != 1:
        raise ReadError("one statement is needed here, not several", Place("<query>", 1, 1), _excerpt(text, 1, 1))
    literal = alternatives[0][0]
    if literal.negated or literal.is_comparison:
        raise ReadError("a plain statement is needed here", Place("<query>", 1, 1), _excerpt(text, 1, 1))
    return literal.atom


@cache
def _parser() -> Lark:
    grammar = Path(__file__).with_name("grammar.lark").read_text(encoding="utf-8")
    return Lark(grammar, parser="lalr", start=["start", "query"], propagate_positions=True, maybe_placeholders=True)


def _parse(text: str, file: str, start: str) -> Tree[Any]:
    try:
        return _parser().parse(text, start=start)
    except UnexpectedInput as mistake:
        raise _read_error(mistake, text, file) from None
    except RecursionError:
        raise ReadError("this text is nested too deeply to be read", Place(file, 1, 1)) from None


def _read_error(mistake: UnexpectedInput, text: str, file: str) -> ReadError:
    line, column = mistake.line, mistake.column
    token = getattr(mistake, "token", None)
    if mistake.pos_in_stream is not None and text.startswith("/*", mistake.pos_in_stream):
        return ReadError("this comment is never closed", Place(file, line, column), _excerpt(text, line, column))
    if isinstance(mistake, UnexpectedCharacters):
        character = text[mistake.pos_in_stream or 0]
        sentence = f"{character!r} does not belong here"
        if character in "'\"":
            sentence = "this quote is never closed on its line"
            return ReadError(sentence, Place(file, line, column), _excerpt(text, line, column))
    elif isinstance(mistake, UnexpectedEOF) or token is None or token.type == "$END":
        written = text.rstrip()  # lark reports the last token; the mistake is what is missing behind it
        line, column = written.count("\n") + 1, len(written) - written.rfind("\n")
        sentence = "the text ends here, in the middle of a clause"
    else:
        sentence = f"{str(token)!r} does not belong here"
    expected = set(getattr(mistake, "accepts", None) or getattr(mistake, "allowed", None) or ())
    wanted = [words for name, words in _EXPECTED.items() if name in expected]
    if wanted:
        sentence += f"; expected {' or '.join(wanted)}"
    return ReadError(sentence, Place(file, line, column), _excerpt(text, line, column))


@contextmanager
def _excerpts(text: str) -> Iterator[None]:
    """Show the line in mistakes that are found after parsing, too."""
    try:
        yield
    except ReadError as mistake:
        if mistake.place is not None and not mistake.excerpt:
            mistake.excerpt = _excerpt(text, mistake.place.line, mistake.place.column)
        raise
    except RecursionError:
        raise ReadError("this text is nested too deeply to be read", Place("<query>", 1, 1)) from None


def _excerpt(text: str, line: int, column: int) -> str:
    lines = text.split("\n")  # as lark counts them: no other character ends a line
    shown = "".join(c if c.isprintable() else " " for c in lines[min(line, len(lines)) - 1])
    return f"    {shown}\n    {' ' * (column - 1)}^"


def _place(tree: Tree[Any] | Token, file: str) -> Place:
    position = tree if isinstance(tree, Token) else tree.meta
    return Place(file, getattr(position, "line", 0) or 0, getattr(position, "column", 0) or 0)


def _sentences(tree: Tree[Any], file: str) -> list[Sentence]:
    """The clauses of one sentence: a rule whose body has alternatives is one clause for each."""
    place, names = _place(tree, file), _Anonymous(file)
    try:
        if tree.data == "directive":
            return [Directive(_statement(tree.children[0], file, names), place)]
        head = _statement(tree.children[0], file, names, _NAMED)
        if tree.data == "fact":
            return [Clause(head, (), place)]
        if tree.data == "rule":
            bodies = _alternatives(tree.children[1], file, names)
            return [Clause(*_renumbered(head, body), place) for body in bodies]
        return [Production(head, _term(tree.children[1], names), place)]
    except RecursionError:
        raise ReadError("this clause is nested too deeply to be read", place) from None


class _Anonymous:
    """Gives each ``_`` of a clause a name of its own that no text can spell: ``_#1``, ``_#2`` …"""

    def __init__(self, file: str) -> None:
        self.file, self.count = file, 0

    def next(self) -> Variable:
        self.count += 1
        return Variable(f"_#{self.count}")


def _renumbered(head: Compound, body: list[Literal]) -> tuple[Compound, tuple[Literal, ...]]:
    """The clause with its anonymous variables numbered anew: equal clauses are equal however they were written."""
    anonymous = [v for v in variables_of(head, *(x.atom for x in body)) if v.name.startswith("_#")]
    names = {old: Variable(f"_#{number}") for number, old in enumerate(anonymous, 1)}
    literals = tuple(Literal(_renamed(x.atom, names), x.negated, x.place) for x in body)
    return _renamed(head, names), literals


def _renamed(term: Term, names: dict[Variable, Variable]) -> Term:
    if isinstance(term, Compound):
        return Compound([_renamed(part, names) for part in term])
    return names.get(term, term) if isinstance(term, Variable) else term


def _statement(tree: Tree[Any], file: str, names: _Anonymous, shapes: frozenset[str] | None = None) -> Compound:
    """The tree as something that can be true; ``shapes`` are the kinds of term allowed (None: all that can)."""
    while tree.data == "group":
        tree = tree.children[0]
    term = _term(tree, names)
    if shapes is _CONDITIONS:
        term = _goal(term)
    is_pair = tree.data == "colon" and isinstance(term, Compound) and term.functor == ":"
    try:
        if shapes is None or (tree.data in shapes and not is_pair):
            return predication(term)
    except TypeError:
        pass
    from casper.kb.terms.syntax import term_text

    sentence = f"{term_text(term)} cannot stand here: a name or name(arguments) is needed"
    raise ReadError(sentence, _place(tree, file)) from None


def _alternatives(tree: Tree[Any], file: str, names: _Anonymous) -> list[list[Literal]]:
    """A body in disjunctive normal form: alternatives, each a list of literals in the author's order."""
    if tree.data == "group":
        return _alternatives(tree.children[0], file, names)
    if tree.data == "then_" or (tree.data == "or_" and any(child.data == "then_" for child in tree.children)):
        return [[_literal(tree, file, names)]]
    if tree.data == "or_":
        return [body for child in tree.children for body in _alternatives(child, file, names)]
    if tree.data == "and_":
        parts = [_alternatives(child, file, names) for child in tree.children]
        return [[literal for part in choice for literal in part] for choice in product(*parts)]
    return [[_literal(tree, file, names)]]


def _literal(tree: Tree[Any], file: str, names: _Anonymous, negated: bool = False) -> Literal:
    if tree.data == "group":
        return _literal(tree.children[0], file, names, negated)
    if tree.data == "not_":
        return _literal(tree.children[1], file, names, not negated)
    if tree.data in ("and_", "or_", "then_"):
        return Literal(_goal(predication(_term(tree, names))), negated, _place(tree, file))
    return Literal(_statement(tree, file, names, _CONDITIONS), negated, _place(tree, file))


def _goal(term: Term) -> Term:
    """The term with the prefixes of its conditions made part of their names."""
    if isinstance(term, Compound) and (term.indicator in CONTROL or term[0] in (",", ";")):
        return Compound((term[0], *map(_goal, term.args)))
    return qualified(term)


def _term(tree: Tree[Any], names: _Anonymous) -> Term:
    children: Sequence[Any] = tree.children
    match tree.data:
        case "atom":
            return _name(children[0])
        case "variable":
            return names.next() if children[0] == "_" else Variable(str(children[0]))
        case "number":
            return _number(children[0], names.file)
        case "negative":
            return -_number(children[1], names.file)
        case "nil":
            return NIL
        case "group":
            return _term(children[0], names)
        case "compound":
            return Compound([_name(children[0]), *(_term(child, names) for child in children[1].children)])
        case "list":
            tail = NIL if children[1] is None else _term(children[1], names)
            return make_list((_term(child, names) for child in children[0].children), tail)
        case "compare" | "binary":
            return Compound((str(children[1]), _term(children[0], names), _term(children[2], names)))
        case "colon":
            return Compound((":", _term(children[0], names), _term(children[1], names)))
        case "not_":
            return Compound(("\\+", _term(children[1], names)))
        case "and_" | "or_" | "then_":
            functor = {"and_": ",", "or_": ";", "then_": "->"}[tree.data]
            return Compound([functor, *(_term(child, names) for child in children)])
    raise AssertionError(f"the grammar has no {tree.data}")


def _name(token: Token) -> str:
    """The atom a token spells, interned: rows are then compared by identity, as Python's own names are."""
    text = str(token)
    if token.type not in ("QUOTED", "TEXT"):
        return sys.intern(text)
    quote, inner = text[0], text[1:-1]
    parts, at = [], 0
    while at < len(inner):
        if inner[at] == "\\":
            parts.append(_ESCAPES.get(inner[at + 1], inner[at + 1]))
            at += 2
        elif inner[at] == quote:  # a doubled quote
            parts.append(quote)
            at += 2
        else:
            parts.append(inner[at])
            at += 1
    return sys.intern("".join(parts))


def _number(token: Token, file: str) -> int | float:
    try:
        value = int(token) if token.isdigit() else float(token)
    except ValueError:  # more digits than Python reads
        value = math.inf
    if value in (math.inf, -math.inf):
        raise ReadError("this number is too large", _place(token, file))
    return value
