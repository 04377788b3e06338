"""The calculi as relations of the knowledge base: which relations there are, what follows from them, what clashes.

In: names of algebras of `casper.qsr`. Out: facts ``relation/2``, ``converse/3``, ``composition/4`` and ``neighbour/3``,
the calculus first, and rules on what a domain says with ``holds(Calculus, A, Relation, B)``.
"""

from __future__ import annotations

from casper.kb.base import KnowledgeBase
from casper.kb.text.reader import read_blocks
from casper.qsr.reasoning.table import algebra

RULES = """
:- dynamic(holds/4).
% told/4: what is said, the other way round too, and what follows from two of them without a choice.
told(C, A, R, B) :- holds(C, A, R, B).
told(C, B, S, A) :- holds(C, A, R, B), converse(C, R, S).
told(C, A, T, D) :- told(C, A, R, B), told(C, B, S, D), A \\== D, only(C, R, S, T).

only(C, R, S, T) :- composition(C, R, S, T), \\+ (composition(C, R, S, U), U \\= T).

% possible/4: what two relations leave to choose from; ruled_out/4: what cannot be any more.
possible(C, A, T, D) :-
    told(C, A, R, B), told(C, B, S, D), A \\== D, composition(C, R, S, T), \\+ ruled_out(C, A, T, D).
ruled_out(C, A, T, D) :- told(C, A, R, B), told(C, B, S, D), A \\== D, relation(C, T), \\+ composition(C, R, S, T).
ruled_out(C, A, T, B) :- told(C, A, R, B), relation(C, T), T \\= R.

never("what is said of three things cannot hold at once") :- told(C, A, T, D), ruled_out(C, A, T, D).
"""


def spatial_knowledge(*names: str) -> KnowledgeBase:
    """A knowledge base that knows the algebras of these names, and the rules above."""
    kb = KnowledgeBase()
    know_algebras(kb, *names)
    return kb


def know_algebras(kb: KnowledgeBase, *names: str) -> None:
    """State the algebras of these names (`casper.qsr.algebra`) and the rules in a knowledge base.

    Raises:
        TraceError: there is no algebra of a name.
        ProgramError: the base has relations of these names that do not fit.
    """
    rows: dict[str, list[tuple[str, ...]]] = {"relation": [], "converse": [], "composition": [], "neighbour": []}
    for name in names:
        for predicate, found in algebra(name).rows().items():
            rows[predicate] += found
    for predicate, found in rows.items():
        kb.facts(predicate, found)
    kb.add(read_blocks(RULES, "<algebras>")[0])
    kb.compile()
