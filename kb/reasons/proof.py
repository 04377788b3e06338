"""Proofs as data, and as text for a person, JSON for a program, a graph for networkx: each in bounded size."""

from __future__ import annotations

from collections import deque
from collections.abc import Hashable, Iterator
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

from casper.kb.reasons.outline import Entry, Numbers, Outline, numbered, outline, premises_first
from casper.kb.reasons.says import SILENT, Words
from casper.kb.reasons.wording import holding_sentence
from casper.kb.terms.clauses import Clause, Literal
from casper.kb.terms.syntax import term_text
from casper.kb.terms.terms import Compound, as_term
from casper.kb.text.lines import Shown
from casper.kb.text.writer import literal_text

if TYPE_CHECKING:
    import networkx as nx

MOST_STEPS = 1_000  # shown of a proof, unless more are asked for
DEEPEST_JSON = 200  # nested further, Python's own JSON writer gives up
MOST_BARS = 16  # levels whose lines are drawn; those further left become their number
MOST_NODES = 10_000  # of a graph


@dataclass(frozen=True, slots=True, eq=False, repr=False)
class Proof(Shown):
    """Why a ground condition holds.

    ``clause`` is the fact or rule behind it and ``premises`` the proofs of its body in the author's order; without a
    clause the condition holds by itself: a comparison, the absence of what is negated, or a computed relation.

    Proofs are equal when they say the same, step by step; comparing, printing and pickling are loops, so a proof may be
    deeper than Python's stack.
    """

    literal: Literal
    clause: Clause | None = None
    premises: tuple[Proof, ...] = ()
    remark: str = ""
    words: Words = SILENT  # in which the whole is told; of the root only

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

    @property
    def size(self) -> int:
        """The number of different steps; one that is used twice counts once."""
        return len(set(self._numbers().values()))

    def premises_first(self) -> Iterator[Proof]:
        """Every node once, premises before what they prove."""
        return premises_first(self)

    def text(self, most_steps: int = MOST_STEPS, deepest: int | None = None) -> str:
        """A tree of at most so many lines; what is proved twice is referred to, ``as above, [3]``.

        A last line, ``… 9,870 more steps``, says how much is left out.
        """
        told = self.outlined(most_steps, most_steps if deepest is None else deepest)
        return "\n".join([*_lines(told, self.words), *filter(None, [told.closing])])

    def __str__(self) -> str:
        return self.text()

    def __repr__(self) -> str:
        return f"<proof of {_text(self)}: {self.height} high, {self.size} step{'' if self.size == 1 else 's'}>"

    def to_networkx(self, most_steps: int = MOST_NODES) -> nx.DiGraph:
        """The proof as a graph: a node a condition (attributes ``text``, ``by``, ``place``), edges to its premises.

        A condition that is used twice is one node; node 0 is what is proved. Of a larger proof the steps nearest to it
        are kept, and ``graph.graph["more"]`` says how many are left out.
        """
        import networkx as nx

        numbers = self._numbers()
        nodes = _nearest(self, numbers, most_steps)
        graph: nx.DiGraph = nx.DiGraph(more=len(set(numbers.values())) - len(nodes))
        names = {number: name for name, number in enumerate(nodes)}
        for number, proof in nodes.items():
            graph.add_node(names[number], text=_text(proof), by=_kind(proof), place=_place(proof))
        for number, proof in nodes.items():
            premises = (numbers[id(premise)] for premise in proof.premises)
            graph.add_edges_from((names[number], names[premise]) for premise in premises if premise in names)
        return graph

    def to_json(self, most_steps: int = MOST_STEPS, deepest: int = DEEPEST_JSON) -> dict[str, Any]:
        """``{"fact": text, "by": "fact"|"rule"|"test"|"absence"|"check", "place": text, "because": […]}``.

        A clause that cites something (``%: …``) has it under ``"cites"``. A part that is used more than once has an
        ``id`` where it is spelled out, and elsewhere is ``{…, "as": id}`` with an empty ``because``. Where something is
        left out the whole has ``more``, the number of further steps, and a part whose premises lie too deep
        ``"cut": true``.
        """
        told = self.outlined(most_steps, deepest)
        premises: list[list[dict[str, Any]]] = [[]]  # by depth, those of the last entry there
        for entry in told.entries:
            shown = _object(entry)
            premises[entry.depth].append(shown)
            del premises[entry.depth + 1 :]
            premises.append(shown.get("because", []))
        [whole] = premises[0]
        return {**whole, "more": told.more} if told.more else whole

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, Proof):
            return NotImplemented
        known: Numbers = {}
        return self is other or self._numbers(known)[id(self)] == other._numbers(known)[id(other)]

    def __hash__(self) -> int:
        return hash((self.literal, self.clause, self.remark, len(self.premises)))

    def __reduce__(self) -> tuple[object, ...]:
        """As a list of steps, premises first, each with the numbers of its premises."""
        steps = list(self.premises_first())
        numbers = {id(proof): number for number, proof in enumerate(steps)}
        rows = [(p.literal, p.clause, tuple(numbers[id(x)] for x in p.premises), p.remark) for p in steps]
        return _of_steps, (rows, self.words)

    def outlined(self, most: int, deepest: int) -> Outline[Proof]:
        """What is shown of it, in the order of the lines: of at most so many steps, none deeper than that."""
        return outline(self, self._numbers(), most, deepest)

    def _numbers(self, known: Numbers | None = None) -> dict[int, int]:
        return numbered(self, _content, {} if known is None else known)


def _of_steps(rows: list[tuple[Literal, Clause | None, tuple[int, ...], str]], words: Words = SILENT) -> Proof:
    """A proof of its steps, premises first."""
    steps: list[Proof] = []
    for literal, clause, premises, remark in rows:
        steps.append(Proof(literal, clause, tuple(steps[number] for number in premises), remark))
    return replace(steps[-1], words=words) if words else steps[-1]


def _content(proof: Proof) -> Hashable:
    return proof.literal, proof.clause, proof.remark


def _nearest(root: Proof, numbers: dict[int, int], most: int) -> dict[int, Proof]:
    """By number the steps nearest to what is proved, nearest first."""
    found = {numbers[id(root)]: root}
    waiting = deque([root])
    while waiting:
        for premise in waiting.popleft().premises:
            if numbers[id(premise)] not in found and len(found) < most:
                found[numbers[id(premise)]] = premise
                waiting.append(premise)
    return found


def _object(entry: Entry[Proof]) -> dict[str, Any]:
    """One step as JSON, its premises still to come."""
    proof = entry.node
    shown: dict[str, Any] = {"fact": _text(proof), "by": _kind(proof), "place": _place(proof) or None}
    if _citation(proof):
        shown["cites"] = _citation(proof)
    if entry.label:
        shown["as" if entry.above else "id"] = entry.label
    if entry.cut:
        shown["cut"] = True
    return {**shown, "because": []}


def _lines(told: Outline[Proof], words: Words) -> Iterator[str]:
    bars: list[str] = []  # by depth, what stands before the lines below the last entry there
    for entry in told.entries:
        del bars[max(entry.depth - 1, 0) :]
        if entry.depth == 0:
            yield _line(entry, words)
            continue
        left = max(len(bars) - MOST_BARS, 0)
        before = (f"{left} more … " if left else "") + "".join(bars[left:])
        yield before + ("└─ " if entry.last else "├─ ") + _line(entry, words)
        bars.append("   " if entry.last else "│  ")


def _line(entry: Entry[Proof], words: Words) -> str:
    proof = entry.node
    text = holding_sentence(proof.literal, words) or _text(proof)
    if entry.above:
        return f"{text}   as above, [{entry.label}]"
    notes = {"fact": "given", "rule": "", "test": "compared", "absence": "not known", "check": proof.remark}
    label, cut = str(entry.label or ""), "…" if entry.cut else ""
    parts = (label, notes[_kind(proof)], _place(proof), _citation(proof), cut)
    return text + "".join(f"   [{part}]" for part in parts if part)


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
    return "" if proof.clause is None else proof.clause.place.brief


def _citation(proof: Proof) -> str:
    return "" if proof.clause is None else proof.clause.place.citation
