"""The reader: text becomes clauses, productions and directives, or one sentence saying where it does not."""

from __future__ import annotations

from collections.abc import Callable
from itertools import product
from pathlib import Path
from typing import NoReturn, TypeAlias

from casper.kb.errors import DomainError, Place, ReadError
from casper.kb.terms.clauses import Clause, Directive, Literal, Production, Sentence
from casper.kb.terms.operators import STANDARD, Operators
from casper.kb.terms.origins import FactBlock
from casper.kb.terms.syntax import COMPARISONS, term_text
from casper.kb.terms.terms import Compound, Term, Variable, predication
from casper.kb.terms.unification import variables_of
from casper.kb.text.bulk_facts import BlockReader
from casper.kb.text.bulk_reader import read_large
from casper.kb.text.directives import OP, Refused, declare, each_of
from casper.kb.text.namespace import qualified
from casper.kb.text.parser import Condition, Parser
from casper.kb.text.tokens import NOTHING, Tokens, excerpt, sentences_of

LARGE = 20_000  # characters from which plain sentences are read by an expression of their own
_TOP = 1199  # the highest priority of a head, or of what follows an arrow
Told: TypeAlias = Callable[[Directive], None]  # who is told of each directive as soon as it is read


def read_text(
    text: str, file: str = "<text>", operators: Operators | None = None, told: Told | None = None
) -> list[Sentence]:
    """Every sentence of the text, in order.

    Args:
        text: what to read.
        file: its name, for places.
        operators: the table in force, which ``:- op(P, T, Name).`` changes; the standard one if None.
        told: called with every other directive when it is reached; what it adds to the operators is in force after it.

    Raises:
        ReadError: with file, line, column and a caret under the first thing that is not of the language.
    """
    return _read(text.removeprefix("\ufeff"), file, STANDARD.copy() if operators is None else operators, told, None)


def read_blocks(text: str, file: str = "<text>") -> tuple[list[Sentence], list[FactBlock]]:
    """As `read_text`, with the long runs of plain facts of a large text as blocks of rows, not as sentences."""
    text = text.removeprefix("\ufeff")
    reader = BlockReader(text, file)
    return _read(text, file, STANDARD.copy(), None, reader), reader.blocks()


def _read(
    text: str, file: str, table: Operators, told: Told | None, blocks: BlockReader | None
) -> list[Sentence]:
    if len(text) < LARGE:
        return read_plainly(text, file, table, told)
    before = table.copy()
    return read_large(
        text, file, lambda part: read_plainly(part, file, table, told), lambda: table.become(before), blocks
    )


def read_plainly(
    text: str, file: str = "<text>", operators: Operators | None = None, told: Told | None = None
) -> list[Sentence]:
    """As `read_text`, sentence by sentence with the parser, however many there are."""
    operators = STANDARD.copy() if operators is None else operators
    places = _Places(text, file)
    found: list[Sentence] = []
    for tokens in sentences_of(text):
        try:
            found += _sentences(Parser(text, file, tokens, operators), places, told)
        except RecursionError:
            place = places.of(tokens.starts[0])
            shown = excerpt(text, place.line, place.column)
            raise ReadError("this clause is nested too deeply to be read", place, shown) from None
    return found


def read_file(path: Path, operators: Operators | None = None, told: Told | None = None) -> list[Sentence]:
    """Every sentence of a file.

    Raises:
        DomainError: the file cannot be read.
        ReadError: as `read_text`.
    """
    return read_text(text_of(path), str(path), operators, told)


def text_of(path: Path) -> str:
    """What a file holds, in UTF-8.

    Raises:
        DomainError: the file cannot be read.
    """
    try:
        return path.read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as mistake:
        raise DomainError(f"cannot read {path} ({mistake})") from None


def read_query(text: str) -> tuple[tuple[Literal, ...], ...]:
    """The alternatives of a query such as ``eat(A, T, D), \\+ A = tiago``: each a conjunction of literals."""
    file, text = "<query>", text.removeprefix("\ufeff")
    sentences = sentences_of(text)
    parser = Parser(text, file, next(sentences, None) or _no_tokens(text), STANDARD)
    try:
        body = parser.body()
        if parser.kinds[parser.at] != NOTHING:
            parser.stop("','")
            following = next(sentences, None)
            if following is not None:
                Parser(text, file, following, STANDARD).unexpected("the end of the question")
        places = _Places(text, file)
        return tuple(tuple(literals) for literals in _alternatives(body, places, parser))
    except RecursionError:
        raise ReadError("this text is nested too deeply to be read", Place(file, 1, 1)) from None


def read_statement(text: str) -> Compound:
    """One atom, such as ``eat(human, biscuits, plate)``; variables and ``_`` are its unknown parts.

    Raises:
        ReadError: when the text is not a single atom.
    """
    alternatives = read_query(text)
    if len(alternatives) != 1 or len(alternatives[0]) != 1:
        raise ReadError("one statement is needed here, not several", Place("<query>", 1, 1), excerpt(text, 1, 1))
    literal = alternatives[0][0]
    if literal.negated or literal.is_comparison:
        raise ReadError("a plain statement is needed here", Place("<query>", 1, 1), excerpt(text, 1, 1))
    return literal.atom


def read_term(text: str, operators: Operators | None = None) -> Term:
    """One term, with or without its full stop.

    Raises:
        ReadError: when the text is not a single term.
    """
    text = text.removeprefix("\ufeff")
    sentences = sentences_of(text)
    parser = Parser(text, "<term>", next(sentences, None) or _no_tokens(text), operators or STANDARD)
    try:
        term = parser.term(1200)
    except RecursionError:
        raise ReadError("this text is nested too deeply to be read", Place("<term>", 1, 1)) from None
    if parser.kinds[parser.at] != NOTHING:
        parser.stop()
    if (following := next(sentences, None)) is not None:
        Parser(text, "<term>", following, STANDARD).unexpected("the end of the text")
    return term


def _no_tokens(text: str) -> Tokens:
    tokens = Tokens()
    tokens.close(text)
    return tokens


class _Places:
    """Offsets of a text as places, counted on from the last one asked for."""

    def __init__(self, text: str, file: str) -> None:
        self.text, self.file = text, file
        self._seen, self._line, self._line_start = 0, 1, 0

    def of(self, at: int) -> Place:
        """The place of an offset."""
        if at < self._seen:
            self._seen, self._line, self._line_start = 0, 1, 0
        new_lines = self.text.count("\n", self._seen, at)
        if new_lines:
            self._line += new_lines
            self._line_start = self.text.rfind("\n", self._seen, at) + 1
        self._seen = at
        return Place(self.file, self._line, at - self._line_start + 1)


def _sentences(parser: Parser, places: _Places, told: Told | None) -> list[Sentence]:
    """The clauses of one sentence: a rule whose body has alternatives is one clause for each."""
    place = places.of(parser.starts[0])
    if parser.texts[0] == ":-" and not parser.opens(0):
        return _directives(parser, place, told)
    start = parser.start_within_brackets()
    term = parser.term(_TOP)
    arrow = parser.texts[parser.at]
    if arrow not in (":-", "-->"):
        parser.stop()
        return [Clause(_statement(term, start, parser), (), place)]
    head = _statement(term, start, parser)
    parser.at += 1
    if arrow == "-->":
        body = parser.sequence(_TOP)
        parser.stop("','")
        return [Production(head, body, place)]
    condition = parser.body()
    parser.stop("','")
    bodies = _alternatives(condition, places, parser)
    return [Clause(*_renumbered(head, literals), place) for literals in bodies]


def _directives(parser: Parser, place: Place, told: Told | None) -> list[Sentence]:
    """What follows ``:-``: operators are declared at once, and are no sentence."""
    parser.at = 1
    start = parser.start_within_brackets()
    term = parser.term(_TOP)
    parser.stop()
    try:
        statement = predication(term)
    except TypeError:
        _cannot_stand(term, start, parser)
    if statement.indicator == OP:
        try:
            declare(statement, parser.operators)
        except Refused as mistake:
            parser.refuse(parser.starts[0], str(mistake))
        return []
    found = [Directive(each, place) for each in each_of(statement)]
    if told is not None:
        for directive in found:
            told(directive)
    return list(found)


def _renumbered(head: Compound, body: list[Literal]) -> tuple[Compound, tuple[Literal, ...]]:
    """The clause with its anonymous variables numbered anew: equal clauses are equal however they were written."""
    anonymous = [v for v in variables_of(head, *(x.atom for x in body)) if v.name.startswith("_#")]
    if not anonymous:
        return head, tuple(body)
    names = {old: Variable(f"_#{number}") for number, old in enumerate(anonymous, 1)}
    literals = tuple(Literal(_renamed(x.atom, names), x.negated, x.place) for x in body)
    return _renamed(head, names), literals


def _renamed(term: Term, names: dict[Variable, Variable]) -> Term:
    if isinstance(term, Compound):
        return Compound([_renamed(part, names) for part in term])
    return names.get(term, term) if isinstance(term, Variable) else term


def _statement(term: Term, start: int, parser: Parser) -> Compound:
    """The term that was just read as something that can be true.

    Raises:
        ReadError: it is a number, a variable, a list, or written with an operator of the standard table.
    """
    if not parser.is_named or (isinstance(term, Compound) and term.indicator == (":", 2)):
        _cannot_stand(term, start, parser)
    return predication(term)


def _cannot_stand(term: Term, start: int, parser: Parser) -> NoReturn:
    parser.refuse(start, f"{term_text(term)} cannot stand here: a name or name(arguments) is needed")


def _alternatives(condition: Condition, places: _Places, parser: Parser) -> list[list[Literal]]:
    """A body in disjunctive normal form: alternatives, each a list of literals in the author's order."""
    if condition.shape == "or":
        return [body for part in condition.parts for body in _alternatives(part, places, parser)]
    if condition.shape == "and":
        parts = [_alternatives(part, places, parser) for part in condition.parts]
        return [[literal for part in choice for literal in part] for choice in product(*parts)]
    return [[_literal(condition, places, parser)]]


def _literal(condition: Condition, places: _Places, parser: Parser, negated: bool = False) -> Literal:
    if condition.shape == "not":
        return _literal(condition.parts[0], places, parser, not negated)
    if condition.shape == "then":
        sentence = "-> cannot stand here: say with \\+ and ; when each of the two is meant"
        parser.refuse(condition.start, sentence)
    if condition.shape != "goal":
        sentence = "only one condition can be negated at a time; give these a rule of their own and negate its head"
        parser.refuse(condition.start, sentence)
    return Literal(_goal(condition, parser), negated, places.of(condition.start))


def _goal(condition: Condition, parser: Parser) -> Compound:
    """A condition's atom: a name, ``name(arguments)``, with a prefix or not, or a comparison."""
    term = qualified(condition.goal)
    is_pair = isinstance(term, Compound) and term.indicator == (":", 2)
    is_qualified = term is not condition.goal and not is_pair
    is_comparison = isinstance(term, Compound) and term.arity == 2 and term.functor in COMPARISONS
    if is_pair or not (condition.is_named or is_qualified or is_comparison):
        _cannot_stand(term, condition.start, parser)
    return predication(term)
