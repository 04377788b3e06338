"""Proofs as data, and their two printers: a text tree for a person, a JSON object for a program."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

from casper.kb.clauses import Clause, Literal
from casper.kb.terms import Compound, as_term
from casper.kb.writer import literal_text, term_text


@dataclass(frozen=True, slots=True)
class Proof:
    """Why a ground condition holds.

    ``clause`` is the fact or rule behind it and ``premises`` the proofs of its body in the author's order; without a
    clause the condition holds by itself: a comparison, the absence of what is negated, or a computed relation.
    """

    literal: Literal
    clause: Clause | None = None
    premises: tuple[Proof, ...] = ()
    remark: str = ""

    @property
    def fact(self) -> Compound:
        """The atom that is proved."""
        return self.literal.atom

    @property
    def height(self) -> int:
        """The number of rule applications on the longest branch."""
        heights: dict[int, int] = {}  # premises first, in a loop: a chain of rules may be longer than Python's stack
        waiting = [self]
        while waiting:
            proof = waiting[-1]
            missing = [premise for premise in proof.premises if id(premise) not in heights]
            if missing:
                waiting.extend(missing)
            else:
                heights[id(proof)] = 1 + max(heights[id(p)] for p in proof.premises) if proof.premises else 0
                waiting.pop()
        return heights[id(self)]

    def __str__(self) -> str:
        return "\n".join(_lines(self))

    def to_json(self) -> dict[str, Any]:
        """``{"fact": text, "by": "fact"|"rule"|"test"|"absence"|"check", "place": text, "because": […]}``."""
        return {
            "fact": _text(self),
            "by": _kind(self),
            "place": _place(self) or None,
            "because": [premise.to_json() for premise in self.premises],
        }


def facts_of(proof: Proof) -> Iterator[Compound]:
    """The given facts a proof rests on, in its order."""
    waiting = [proof]
    while waiting:
        proof = waiting.pop()
        if _kind(proof) == "fact":
            yield proof.fact
        waiting.extend(reversed(proof.premises))


def _lines(proof: Proof) -> Iterator[str]:
    waiting = [(proof, "", "")]  # with what stands before its first line, and before those of its premises
    while waiting:
        proof, first, other = waiting.pop()
        yield first + _line(proof)
        for at, premise in reversed(list(enumerate(proof.premises, 1))):
            last = at == len(proof.premises)
            waiting.append((premise, other + ("└─ " if last else "├─ "), other + ("   " if last else "│  ")))


def _line(proof: Proof) -> str:
    notes = {"fact": "given", "rule": "", "test": "compared", "absence": "not known", "check": proof.remark}
    note = notes[_kind(proof)]
    return _text(proof) + "".join(f"   [{part}]" for part in (note, _place(proof)) if part)


def _text(proof: Proof) -> str:
    return literal_text(proof.literal) if proof.literal.negated else term_text(as_term(proof.fact))


def _kind(proof: Proof) -> str:
    if proof.remark:
        return "check"
    if proof.clause is not None:
        return "rule" if proof.clause.body else "fact"
    return "absence" if proof.literal.negated and not proof.literal.is_comparison else "test"


def _place(proof: Proof) -> str:
    if proof.clause is None or not proof.clause.place.line:
        return ""
    file = proof.clause.place.file.rsplit("/", 1)[-1]
    return f"{file}:{proof.clause.place.line}"
