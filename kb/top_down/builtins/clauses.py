"""Built-in predicates that are clauses like any other, as in SWI-Prolog's library(lists) and library(apply).

What they need is the library's own, under names that no program's text can define, so that a program's own ``append/3``
changes what its rules say and not what ``last/2`` means.
"""

from __future__ import annotations

from functools import cache

from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Term
from casper.kb.text.reader import read_text
from casper.kb.top_down.compiled.code import CompiledClause, Procedure

_TEXT = """
append([], L, L).
append([H | T], L, [H | R]) :- append(T, L, R).
member(X, [Y | Ys]) :- among(Ys, X, Y).
among(_, X, X).
among([Y | Ys], X, _) :- among(Ys, X, Y).
select(X, [H | T], Rest) :- selected(T, H, X, Rest).
selected(T, H, H, T).
selected([H2 | T], H, X, [H | Rest]) :- selected(T, H2, X, Rest).
last([X | Xs], Last) :- ends(Xs, X, Last).
ends([], Last, Last).
ends([X | Xs], _, Last) :- ends(Xs, X, Last).
reverse(Xs, Ys) :- turned(Xs, [], Ys).
turned([], Ys, Ys).
turned([X | Xs], Rest, Ys) :- turned(Xs, [X | Rest], Ys).
nth0(I, L, E) :- '$known'(I), '$item'(I, L, E).
nth0(I, L, E) :- '$open'(I), L = [H | T], numbered(T, H, E, 0, I).
nth1(I, L, E) :- '$known'(I), J is I - 1, '$item'(J, L, E).
nth1(I, L, E) :- '$open'(I), L = [H | T], numbered(T, H, E, 1, I).
numbered(_, E, E, I, I).
numbered([H | T], _, E, N, I) :- M is N + 1, numbered(T, H, E, M, I).
maplist(G, L) :- each(L, G).
each([], _).
each([A | As], G) :- call(G, A), each(As, G).
maplist(G, L, M) :- each(L, M, G).
each([], [], _).
each([A | As], [B | Bs], G) :- call(G, A, B), each(As, Bs, G).
maplist(G, L, M, N) :- each(L, M, N, G).
each([], [], [], _).
each([A | As], [B | Bs], [C | Cs], G) :- call(G, A, B, C), each(As, Bs, Cs, G).
include(G, L, In) :- parted(L, G, In, _).
exclude(G, L, Out) :- parted(L, G, _, Out).
partition(G, L, In, Out) :- parted(L, G, In, Out).
parted([], _, [], []).
parted([A | As], G, [A | In], Out) :- call(G, A), parted(As, G, In, Out).
parted([A | As], G, In, [A | Out]) :- \\+ call(G, A), parted(As, G, In, Out).
foldl(G, L, V, W) :- folded(L, G, V, W).
folded([], _, V, V).
folded([A | As], G, V, W) :- call(G, A, V, U), folded(As, G, U, W).
foldl(G, L, M, V, W) :- folded(L, M, G, V, W).
folded([], [], _, V, V).
folded([A | As], [B | Bs], G, V, W) :- call(G, A, B, V, U), folded(As, Bs, G, U, W).
"""
_OWN = "library: "  # in front of the name of what is the library's own


@cache
def library() -> dict[Indicator, Procedure]:
    """The compiled clauses of every library predicate, under its public name where it has one, and under its own."""
    table: dict[Indicator, list[Clause]] = {}
    for clause in read_text(_TEXT, "<library>"):
        assert isinstance(clause, Clause)
        table.setdefault(clause.head.indicator, []).append(clause)
    found: dict[Indicator, Procedure] = {}
    for (name, arity), clauses in table.items():
        own = [CompiledClause(_owned(clause, table)) for clause in clauses]
        procedure = found[_OWN + name, arity] = Procedure(own, arity)
        if (name, arity) in BUILTINS:
            found[name, arity] = procedure
    return found


def _owned(clause: Clause, table: dict[Indicator, list[Clause]]) -> Clause:
    """The clause with the library's own names in its body (its head's name is never looked at)."""
    body = tuple(Literal(_renamed(x.atom), x.negated) if x.atom.indicator in table else x for x in clause.body)
    return Clause(clause.head, body)


def _renamed(atom: Term) -> Compound:
    return Compound((_OWN + atom[0], *atom.args))
