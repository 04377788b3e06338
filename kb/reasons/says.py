"""An author's own words: ``say(Term, "… {X} …")`` gives the sentence of what a term says, in a language or in any.

    say(eat(A, T, D), "{A} eats {T} from {D}").          what holds, an action, a goal
    say(\\+ human(X), "{X} is not a person").             that it does not hold
    say(fr, plate, "l'assiette").                        a thing, in French

The first that fits and whose values are known is told, those of the language before those of any. What nobody worded is
told as the term it is.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from typing import TypeAlias

from casper.kb.reasons.phrases import PHRASES, phrased
from casper.kb.terms.clauses import Clause, Indicator
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import NIL, Compound, Term, Variable, list_items, predication
from casper.kb.terms.unification import is_ground

SAYS: tuple[Indicator, Indicator] = (("say", 2), ("say", 3))
DEEPEST = 8  # sentences within sentences
_PLACEHOLDER = re.compile(r"\{\{|\}\}|\{\s*(\w+)\s*\}")
_Key: TypeAlias = tuple[str, int, bool]  # name, arity, whether it is denied


@dataclass(frozen=True, slots=True)
class Say:
    """The sentence of a pattern: its text, and the names of the variables whose values stand in it."""

    about: Compound
    denied: bool
    parts: tuple[str, ...]  # texts, and between any two of them the name of a variable
    language: str
    clause: Clause

    @property
    def names(self) -> tuple[str, ...]:
        """The variables in the sentence, in its order."""
        return self.parts[1::2]

    @property
    def key(self) -> _Key:
        """What it is found by."""
        return (*self.about.indicator, self.denied)


def is_say(clause: Clause) -> bool:
    """Whether a clause words something: ``say/2`` or ``say/3`` with a text. Any other is the author's own relation."""
    return clause.head.indicator in SAYS and isinstance(clause.head[-1], str)


def say_of(clause: Clause) -> Say | None:
    """What a clause words; None where its first part is no term that can be worded, or it has conditions."""
    term, language = clause.head[-2], clause.head[1] if clause.head.arity == 3 else ""
    denied = isinstance(term, Compound) and term.indicator in (("\\+", 1), ("not", 1))
    term = term[1] if denied else term
    if clause.body or not isinstance(term, (str, Compound)) or not isinstance(language, str):
        return None
    return Say(predication(term), denied, parts_of(str(clause.head[-1])), language, clause)


def parts_of(sentence: str) -> tuple[str, ...]:
    """Texts and, between any two of them, the name of a variable; ``{{`` and ``}}`` are brackets."""
    parts, at = [""], 0
    for found in _PLACEHOLDER.finditer(sentence):
        parts[-1] += sentence[at : found.start()]
        at = found.end()
        if found[1] is None:
            parts[-1] += found[0][0]
        else:
            parts += [found[1], ""]
    parts[-1] += sentence[at:]
    return tuple(parts)


@dataclass(frozen=True)
class Words:
    """The sentences of a base in one language; ``language`` empty: those of any."""

    language: str = ""
    table: Mapping[_Key, tuple[Say, ...]] = field(default_factory=dict)
    languages: tuple[str, ...] = ()  # that somebody said something in

    def __bool__(self) -> bool:
        return bool(self.table)

    @property
    def is_foreign(self) -> bool:
        """Whether what is said around sentences is in another language than English."""
        return self.language in PHRASES and self.language != "en"

    def sentence(self, atom: Compound, denied: bool = False, plainly: bool = False) -> str | None:
        """The sentence that something holds, or that it does not; None where nobody worded it.

        Where only the one is worded that it holds, that it does not is made of it, unless it is asked for ``plainly``.
        """
        said = self._said(atom, denied, 0)
        if said is None and denied and not plainly:
            said = self._said(atom, False, 0)
            return None if said is None else self.phrase("not so", said)
        return said

    def text(self, term: Term) -> str:
        """A term in words where it has some, otherwise as the term it is."""
        said = self.sentence(predication(term)) if isinstance(term, (str, Compound)) else None
        return term_text(term) if said is None else said

    def constraint(self, sentence: str) -> str:
        """The sentence of a constraint, in the language where somebody said it so."""
        return self._said(Compound(("never", sentence)), False, 0) or sentence

    def named(self, name: str) -> str | None:
        """The first sentence about what has a name, whatever its arguments, that needs none of them."""
        for (functor, _, denied), says in self.table.items():
            for say in says:
                if functor == name and not denied and not say.names and len(say.about) > 1:
                    return say.parts[0]
        return None

    def phrase(self, name: str, *values: object) -> str:
        """What the base itself says around sentences."""
        return phrased(PHRASES, self.language, name, *values)

    def _said(self, atom: Compound, denied: bool, depth: int) -> str | None:
        for say in self.table.get((*atom.indicator, denied), ()):
            found: dict[str, Term] = {}
            told = self._filled(say, found, depth) if fits(say.about, atom, found) else None
            if told is not None:
                return told
        return None

    def _filled(self, say: Say, found: Mapping[str, Term], depth: int) -> str | None:
        parts = list(say.parts)
        for at, name in enumerate(say.names):
            value = self._value(found.get(name, Variable(name)), depth)
            if value is None:
                return None
            parts[2 * at + 1] = value
        return "".join(parts)

    def _value(self, value: Term, depth: int) -> str | None:
        """How a value is called; None for one that is open."""
        if isinstance(value, Variable):
            return None
        if isinstance(value, Compound) and value.indicator == (".", 2) and depth < DEEPEST:
            items, tail = list_items(value)
            told = [self._value(item, depth + 1) for item in items]
            return ", ".join(map(str, told)) if tail == NIL and None not in told else None
        if isinstance(value, (str, Compound)) and depth < DEEPEST:
            said = self._said(predication(value), False, depth + 1)
            if said is not None:
                return said
        if not is_ground(value):
            return None
        return value if isinstance(value, str) else term_text(value)


SILENT = Words()
"""Nobody worded anything."""


def words_of(clauses: Iterable[Clause], language: str = "") -> Words:
    """What the clauses of say/2 and say/3 word, in a language and, behind that, in any."""
    says = [say for clause in clauses if is_say(clause) and (say := say_of(clause)) is not None]
    table: dict[_Key, list[Say]] = {}
    for wanted in dict.fromkeys((language, "")):
        for say in says:
            if say.language == wanted:
                table.setdefault(say.key, []).append(say)
    spoken = tuple(dict.fromkeys(say.language for say in says if say.language))
    return Words(language, {key: tuple(found) for key, found in table.items()}, spoken)


def fits(pattern: Term, term: Term, found: dict[str, Term]) -> bool:
    """Whether a term is an instance of a pattern; ``found`` gets the values of the pattern's variables."""
    waiting = [(pattern, term)]
    while waiting:
        wanted, given = waiting.pop()
        if isinstance(wanted, Variable):
            if not wanted.is_anonymous and found.setdefault(wanted.name, given) != given:
                return False
        elif isinstance(wanted, Compound):
            if not isinstance(given, Compound) or len(given) != len(wanted) or given[0] != wanted[0]:
                return False
            waiting.extend(zip(wanted.args, given.args))
        elif isinstance(given, Variable) or wanted != given:
            return False
    return True
