"""The parser: the tokens of a sentence become terms, by the priorities of operators.

``a, b, c`` is ISO Prolog's ``','(a, ','(b, c))``; in the body of a production it is one sequence of three, as plans are
written. The bodies of rules are read by `conditions`.
"""

from __future__ import annotations

import sys
from collections.abc import Sequence
from typing import NoReturn

from casper.kb.errors import ReadError
from casper.kb.terms.operators import ARGUMENT, HIGHEST, Operators
from casper.kb.terms.terms import NIL, Compound, Term, Variable, make_list
from casper.kb.text.parsing.places import mistake_at
from casper.kb.text.parsing.tokens import (
    CODES,
    END,
    MISTAKE,
    NAME,
    NOTHING,
    NUMBER,
    PUNCTUATION,
    QUOTED,
    VARIABLE,
    Tokens,
    Unreadable,
    number,
    unquoted,
)

_STARTS = frozenset({NAME, QUOTED, CODES, VARIABLE, NUMBER})
_OPENING = frozenset("([{")
_PLAIN = 0  # the priority of a term that stands in brackets, or is no operator's
_OPERAND = "a name or a variable or '('"


def right_fold(functor: str, terms: Sequence[Term]) -> Term:
    """``a, b, c`` as ``','(a, ','(b, c))``."""
    result = terms[-1]
    for term in reversed(terms[:-1]):
        result = Compound((functor, term, result))
    return result


class Parser:
    """Reads one sentence.

    Args:
        text: all of the text, for the line that is shown with a mistake.
        file: its name.
        tokens: those of the sentence.
        operators: the table in force.

    ``at`` is the number of the next token; ``is_named`` tells of the last term whether it is written as a name or
    ``name(arguments)``, or with an operator that the text declared: only then it can be a statement.
    """

    def __init__(self, text: str, file: str, tokens: Tokens, operators: Operators) -> None:
        self.text, self.file, self.tokens, self.operators = text, file, tokens, operators
        self.kinds, self.texts, self.starts = tokens.kinds, tokens.texts, tokens.starts
        self.at = 0
        self.is_named = False
        self.sequences = False  # whether ``a, b, c`` is one term of three, as in productions
        self._priority = _PLAIN  # of the last term
        self._anonymous = 0

    # --- terms ------------------------------------------------------------------------------------------------------

    def term(self, most: int) -> Term:
        """A term of at most that priority.

        Raises:
            ReadError: there is none.
        """
        at = self.at
        kind, word = self.kinds[at], self.texts[at]
        if kind == PUNCTUATION and word in _OPENING:
            left = self._listed() if word == "[" else self._bracketed(word)
        elif kind in (NAME, QUOTED) and self.opens(at):
            left = self._compound(sys.intern(word if kind == NAME else self._decoded(at)))
        else:
            left = self._operand(most)
        return self.continued(left, self._priority, most)

    def sequence(self, most: int) -> Term:
        """A term in which ``a, b, c`` is one sequence of three, and ``a ; b ; c`` one choice."""
        self.sequences = True
        return self.term(most)

    def start_within_brackets(self) -> int:
        """Where the next term starts, brackets around all of it left out."""
        at = self.at
        while self.texts[at] == "(":
            at += 1
        return self.starts[at]

    def continued(self, left: Term, priority: int, most: int) -> Term:
        """A term that starts with a term that is read already, and goes on with operators of at most that priority."""
        infix = self.operators.infix
        while True:
            name = self.texts[self.at]
            if (found := infix.get(name)) is None or not self.is_operator():
                if not self.is_operator() or (after := self.operators.postfix.get(name)) is None:
                    break
                if after[0] > most or priority > after[1]:
                    break
                self.at += 1
                left, priority = Compound((sys.intern(name), left)), after[0]
            else:
                own, left_most, right_most = found
                if own > most:
                    break
                if priority > left_most:
                    self._clash()
                if name in (",", ";"):
                    left = self._series(name, left, right_most)
                else:
                    self.at += 1
                    left = Compound((sys.intern(name), left, self.term(right_most)))
                priority = own
            self.is_named = name in self.operators.own
        self._priority = priority
        return left

    def _series(self, name: str, first: Term, most: int) -> Term:
        """``a, b, c``: a loop, because a sequence may be longer than Python's stack."""
        items = [first]
        while self.texts[self.at] == name and self.is_operator():
            self.at += 1
            items.append(self.term(most - 1))
        return Compound((name, *items)) if self.sequences else right_fold(name, items)

    def is_operator(self) -> bool:
        """Whether the next token can be an operator."""
        kind = self.kinds[self.at]
        return kind == NAME or (kind == PUNCTUATION and self.texts[self.at] in ",|")

    def _operand(self, most: int) -> Term:
        """A name, a variable, a number, or a term after a prefix operator; its priority is kept."""
        at = self.at
        kind, word = self.kinds[at], self.texts[at]
        self.at = at + 1
        self._priority, self.is_named = _PLAIN, False
        if kind == NAME:
            if word == "-" and self._is_negative(at):
                self.at += 1
                return -self._number(at + 1)
            prefix = self.operators.prefix.get(word)
            if prefix is not None and prefix[0] <= most and self._has_operand(prefix[1]):
                return self._prefixed(sys.intern(word), prefix)
            self.is_named = True
            return sys.intern(word)
        if kind == VARIABLE:
            return self._variable(word)
        if kind == NUMBER:
            return self._number(at)
        if kind == QUOTED:
            self.is_named = True
            return sys.intern(self._decoded(at))
        if kind == CODES:
            return make_list(map(ord, self._decoded(at)))
        self.at = at
        self.unexpected(_OPERAND)

    def _is_negative(self, at: int) -> bool:
        """Whether a minus sign is a number's: it stands right before it."""
        return self.kinds[at + 1] == NUMBER and self.starts[at + 1] == self.starts[at] + 1

    def _prefixed(self, name: str, prefix: tuple[int, int]) -> Term:
        priority, most = prefix
        operand = self.term(most)
        self._priority, self.is_named = priority, name in self.operators.own
        return Compound((name, operand))

    def _has_operand(self, most: int) -> bool:
        """Whether the prefix operator before the next token is one here, and not an atom: ``- a``, but ``- = a``."""
        at = self.at
        if not self._can_start(at):
            return False
        word = self.texts[at]
        if self.kinds[at] != NAME or word not in self.operators.infix or self.opens(at):
            return True
        if word == "-" and self._is_negative(at):
            return True
        if word in self.operators.prefix:
            return self.operators.prefix[word][0] <= most
        return not self._can_start(at + 1)

    def _can_start(self, at: int) -> bool:
        return self.kinds[at] in _STARTS or (self.kinds[at] == PUNCTUATION and self.texts[at] in _OPENING)

    def opens(self, at: int) -> bool:
        """Whether a bracket follows a token at once: what stands in it are arguments."""
        return self.texts[at + 1] == "(" and self.starts[at + 1] == self.tokens.end(at)

    def _compound(self, name: str) -> Compound:
        """``name(arguments)``. (The loops here are not shared: every call in between costs depth of nesting.)"""
        self.at += 2
        arguments = [self.term(ARGUMENT)]
        while self.takes(","):
            arguments.append(self.term(ARGUMENT))
        self.expect(")", "','")
        self._priority, self.is_named = _PLAIN, True
        return Compound((name, *arguments))

    def _listed(self) -> Term:
        """``[items | tail]``."""
        self.at += 1
        self._priority, self.is_named = _PLAIN, False
        if self.takes("]"):
            return NIL
        items, tail = [self.term(ARGUMENT)], NIL
        while self.takes(","):
            items.append(self.term(ARGUMENT))
        if self.takes("|"):
            tail = self.term(ARGUMENT)
            self.expect("]")
        else:
            self.expect("]", "','")
        self._priority, self.is_named = _PLAIN, False
        return make_list(items, tail)

    def _bracketed(self, opening: str) -> Term:
        """``(term)``, ``{term}``, or the atom ``{}``."""
        self.at += 1
        if opening == "(":
            term = self.term(HIGHEST)
            self.expect(")")
            self._priority = _PLAIN
            return term
        if self.takes("}"):
            if self.texts[self.at] == "(" and self.starts[self.at] == self.tokens.end(self.at - 1):
                self.at -= 1
                return self._compound("{}")
            self._priority, self.is_named = _PLAIN, False
            return "{}"
        term = Compound(("{}", self.term(HIGHEST)))
        self.expect("}")
        self._priority, self.is_named = _PLAIN, False
        return term

    def _variable(self, word: str) -> Variable:
        if word != "_":
            return Variable(sys.intern(word))
        self._anonymous += 1
        return Variable(f"_#{self._anonymous}")

    def _number(self, at: int) -> int | float:
        try:
            return number(self.texts[at])
        except Unreadable as mistake:
            self.refuse(self.starts[at], mistake.sentence, mistake.quoted)

    def _decoded(self, at: int) -> str:
        try:
            return unquoted(self.texts[at])
        except Unreadable as mistake:
            self.refuse(self.starts[at] + mistake.at, mistake.sentence, mistake.quoted)

    # --- what is wrong ----------------------------------------------------------------------------------------------

    def takes(self, sign: str) -> bool:
        """Go past the next token if it is that sign; whether it was."""
        if self.texts[self.at] == sign:
            self.at += 1
            return True
        return False

    def expect(self, closing: str, *others: str) -> None:
        """Go past a closing bracket.

        Raises:
            ReadError: something else stands there.
        """
        if not self.takes(closing):
            self.unexpected(f"'{closing}'", *others)

    def refuse(self, at: int, sentence: str, quoted: str = "") -> NoReturn:
        """Raise a mistake at an offset of the text; ``quoted`` is what the sentence repeats of it."""
        raise mistake_at(self.text, self.file, at, sentence, quoted)

    def _clash(self) -> NoReturn:
        word = repr(self.texts[self.at])
        sentence = "the operator before it binds no tighter; put one of the two in brackets"
        self.refuse(self.starts[self.at], f"{word} does not belong here: {sentence}", word)

    def unexpected(self, *expected: str) -> NoReturn:
        """Raise that the next token does not belong there, with what would."""
        raise self._mistake(f"; expected {' or '.join(expected)}")

    def _mistake(self, expected: str) -> ReadError:
        kind, word, start = self.kinds[self.at], self.texts[self.at], self.starts[self.at]
        if kind == NOTHING:
            start = len(self.text.rstrip())
            return mistake_at(self.text, self.file, start, f"the text ends here, in the middle of a clause{expected}")
        if kind == MISTAKE and self.text.startswith("/*", start):
            return mistake_at(self.text, self.file, start, "this comment is never closed")
        if kind == MISTAKE and word in "'\"`":
            return mistake_at(self.text, self.file, start, "this quote is never closed on its line")
        return mistake_at(self.text, self.file, start, f"{word!r} does not belong here{expected}", repr(word))

    def stop(self, *others: str) -> None:
        """Go past the full stop.

        Raises:
            ReadError: something else stands there.
        """
        if self.kinds[self.at] != END:
            is_stop = self.texts[self.at] == "."
            self.unexpected("a space or a new line after a full stop" if is_stop else "a full stop", *others)
        self.at += 1
