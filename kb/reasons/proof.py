"""Proofs as data, and their two printers: a text tree for a person, a JSON object for a program."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.writer import literal_text

if TYPE_CHECKING:
    import networkx as nx


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
        heights: dict[int, int] = {}
        for proof in self.premises_first():
            heights[id(proof)] = 1 + max(heights[id(p)] for p in proof.premises) if proof.premises else 0
        return heights[id(self)]

    def premises_first(self) -> Iterator[Proof]:
        """Every node once, premises before what they prove: a loop, since a proof may be deeper than Python's stack."""
        seen: set[int] = set()
        waiting = [self]
        while waiting:
            proof = waiting[-1]
            missing = [premise for premise in proof.premises if id(premise) not in seen]
            if missing:
                waiting.extend(missing)
                continue
            waiting.pop()
            if id(proof) not in seen:
                seen.add(id(proof))
                yield proof

    def __str__(self) -> str:
        return "\n".join(_lines(self))

    def to_networkx(self) -> nx.DiGraph:
        """The proof as a graph: a node a condition (attributes ``text``, ``by``, ``place``), edges to its premises.

        A condition that is used twice is one node; node 0 is what is proved.
        """
        import networkx as nx

        graph: nx.DiGraph = nx.DiGraph()
        nodes = list(self.premises_first())[::-1]
        numbers = {id(proof): number for number, proof in enumerate(nodes)}
        for proof in nodes:
            graph.add_node(numbers[id(proof)], text=_text(proof), by=_kind(proof), place=_place(proof))
            graph.add_edges_from((numbers[id(proof)], numbers[id(premise)]) for premise in proof.premises)
        return graph

    def to_json(self) -> dict[str, Any]:
        """``{"fact": text, "by": "fact"|"rule"|"test"|"absence"|"check", "place": text, "because": […]}``."""
        found: dict[int, dict[str, Any]] = {}
        for proof in self.premises_first():
            found[id(proof)] = {
                "fact": _text(proof),
                "by": _kind(proof),
                "place": _place(proof) or None,
                "because": [found[id(premise)] for premise in proof.premises],
            }
        return found[id(self)]


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
    is_written_otherwise = proof.literal.negated or proof.literal.shown is not None
    return literal_text(proof.literal) if is_written_otherwise else term_text(as_term(proof.fact))


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
