"""Sentences a person is shown: why a condition fails, in words rather than in clauses."""

from __future__ import annotations

from casper.kb.reasons.says import SILENT, Words
from casper.kb.terms.clauses import Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, Variable, as_term
from casper.kb.terms.unification import is_ground, renamed

_ADJECTIVE_ENDINGS = ("able", "ible", "ful", "less", "ing", "ed", "ous", "ive", "al", "y", "ic", "ent", "ant")
_MASS_NOUNS = frozenset({"food", "water", "furniture", "equipment", "cutlery", "bread", "milk"})
_NOUNS = frozenset(  # with the ending of an adjective
    {"agent", "animal", "baby", "battery", "bed", "body", "boy", "building", "cable", "key", "meal", "patient"}
    | {"plant", "ring", "table", "toy", "tray", "vegetable"}
)
_ADJECTIVES = frozenset(  # without one
    {"broken", "clean", "cold", "fresh", "full", "good", "hot", "old", "open", "raw", "safe", "warm", "wet"}
)


def failure_sentence(literal: Literal, words: Words = SILENT) -> str:
    """Why the (instantiated) condition does not hold: ``tiago is not a human``, or what its author says of that."""
    atom = literal.atom
    if literal.remark:
        return literal.remark
    if words and literal.shown is None:
        said = words.sentence(_shown(atom), denied=not literal.negated)
        if said is not None:
            return said
    if literal.shown is not None:
        shown = term_text(literal.shown)
        return f"{shown} {'holds' if literal.negated else 'does not hold'}"
    if literal.is_comparison:
        return _comparison_sentence(literal)
    if atom.arity == 1 and is_ground(atom):
        return f"{term_text(atom[1])} is {'' if literal.negated else 'not '}{noun_phrase(atom.functor)}"
    if atom.arity == 1 and not literal.negated and isinstance(atom[1], Variable):
        return f"nothing is {noun_phrase(atom.functor)}"
    text = term_text(as_term(_shown(atom)))
    return f"{text} {'holds' if literal.negated else 'does not hold'}"


def holding_sentence(literal: Literal, words: Words) -> str | None:
    """What the author says of an (instantiated) condition that holds; None where nothing is said of it."""
    if not words or literal.shown is not None:
        return None
    return words.sentence(_shown(literal.atom), denied=literal.negated)


def noun_phrase(name: str) -> str:
    """A predicate's name as what something is: ``a vessel``, ``an agent``, but ``eatable`` and ``food``."""
    words = name.replace("_", " ")
    if words.endswith("s") and not words.endswith("ss"):  # biscuits, hobs
        return words
    if words in _MASS_NOUNS | _ADJECTIVES or (words not in _NOUNS and words.endswith(_ADJECTIVE_ENDINGS)):
        return words
    return f"{'an' if words[:1] in 'aeiou' else 'a'} {words}"


def _comparison_sentence(literal: Literal) -> str:
    operator, left, right = literal.atom
    left, right = (term_text(side) for side in renamed((left, right), 0))
    same = operator in ("=", "==")
    if literal.negated:
        same = not same
    if operator in ("=", "==", "\\=", "\\=="):
        return f"{left} is not {right}" if same else f"{left} is {right}" if left != right else f"both are {right}"
    return f"{left} {operator} {right} {'holds' if literal.negated else 'does not hold'}"


def _shown(atom: Compound) -> Compound:
    """The atom with renamed variables shown by the name their author gave them."""
    return Compound(renamed(atom, 0))
