"""Random programs with aggregates, lists and arithmetic, against SWI-Prolog."""

from __future__ import annotations

import random
from pathlib import Path

from programs import atoms_of
from swi import answers
from tally import Tally

from casper.kb.base import KnowledgeBase
from casper.kb.errors import CasperError
from casper.kb.terms.terms import Compound, list_items, make_list
from casper.kb.terms.values.ordering import standard_key

DERIVED = {"d": 2, "f": 1, "g": 2, "h": 1}
GIVEN = {"b": 1, "e": 2}
WAYS = ["count", "sum(Y)", "sum(Y * 2 - 1)", "min(Y)", "max(Y)", "bag(Y)", "set(k(Y))", "max(Y, Y)", "min(Y, x)"]
EXPRESSIONS = ["Y + 1", "Y * Y - X", "X mod 2", "Y // 2", "max(X, Y)", "abs(Y)", "Y ** 2", "2 ** X", "7 / X", "gcd(X, Y)",
               "0 - Y", "X /\\ Y", "X xor 5", "X << 2", "Y >> 1", "sign(Y)", "truncate(X / 2)", "X rem 2", "X div 2", "min(X, 1)"]  # fmt: skip


def _random_goal(rng: random.Random, below: list[str]) -> str:
    """A goal about X (known) that gives Y."""
    name = rng.choice([n for n in [*below, "e"] if {**DERIVED, **GIVEN}[n] == 2])
    extra = rng.choice([", true", ", true", ", Y > 1", ", \\+ b(Y)", ", b(Y)", ", Y =\\= X"])
    other = rng.choice(["", "", "", " ; e(Y, X)", " ; b(Y), Y < X"])
    return f"({name}(X, Y){extra}{other})"


def _random_rule(rng: random.Random, name: str, below: list[str]) -> str:
    test = rng.choice(["e(X, 1)", "X > 1", "\\+ e(X, _)", f"\\+ {_random_goal(rng, below)}", f"forall({_random_goal(rng, below)}, b(Y))"])
    if {**DERIVED}[name] == 1:
        other = _random_goal(rng, below)
        return f"{name}(X) :- b(X), {rng.choice([test, f'not({other})', f'(X < 2 ; {test})', f'{other}, Y >= X'])}."
    kind = rng.randrange(4)
    if kind == 0:
        return f"{name}(X, Z) :- e(X, Y), Z is {rng.choice(EXPRESSIONS)}."
    if kind == 1:
        return f"{name}(X, Z) :- b(X), ({test} -> Z = 1 ; Z is X + 10)."
    if kind == 2:
        return f"{name}(X, L) :- b(X), findall(Y, {_random_goal(rng, below)}, L)."
    return f"{name}(X, N) :- b(X), aggregate_all({rng.choice(WAYS)}, {_random_goal(rng, below)}, N)."


LISTED = ["length(L, Z)", "sum_list(L, Z)", "min_list(L, Z)", "max_list(L, Z)", "last(L, Z)", "reverse(L, Z)", "nth0(X, L, Z)",
          "nth1(X, L, Z)", "nth0(Z, L, X)", "member(Z, L)", "member(X, L), Z = L", "memberchk(X, L), Z = 1", "append([X], L, Z)",
          "append(Z, [_ | _], L)", "append(_, Z, L)", "select(X, L, Z)", "select(Z, L, _)", "sort([X | L], Z)", "msort([X | L], Z)",
          "length(L, N), Z is N * X", "L = [Z | _]", "L = [_ | Z]", "forall(member(Y, L), Y > X), Z = L", "\\+ member(X, L), Z = L",
          "sort(L, S), findall(Y - X, member(Y, S), Z)", "aggregate_all(max(Y), member(Y, L), Z)", "append(L, [X], M), reverse(M, Z)",
          "back(L, [], Z)", "halves(L, Z, _)", "maplist(less(X), L), Z = L", "call(nth0, X, L, Z)"]  # fmt: skip
HELPING = {"back": 3, "less": 2, "halves": 3}
LISTS = [
    "back([], A, A).", "back([H | T], A, R) :- back(T, [H | A], R).", "less(X, Y) :- X < Y.",
    "halves([], [], []).", "halves([H | T], [H | A], B) :- halves(T, B, A).",
]  # fmt: skip


def random_list_rules(rng: random.Random) -> list[str]:
    """Rules that give ``l(X, Z)`` from sorted lists of numbers, by built-ins and by recursion of their own."""
    listed = f"findall(Y, {_random_goal(rng, [])}, L0), {rng.choice(['msort', 'sort'])}(L0, L)"
    return [*LISTS, *(f"l(X, Z) :- b(X), {listed}, {rng.choice(LISTED)}." for _ in range(rng.randrange(1, 4)))]


def random_program(rng: random.Random) -> list[str]:
    """Facts, most of them about numbers, and rules that count, add and list what is below them."""
    numbers = ["-2", "0", "1", "2", "3", "5"]
    values = [*numbers, "ann"] if rng.random() < 0.15 else numbers
    clauses = [f"b({rng.choice(values)})." for _ in range(rng.randrange(1, 5))]
    clauses += [f"e({rng.choice(values)}, {rng.choice(values)})." for _ in range(rng.randrange(1, 8))]
    for at, name in enumerate(DERIVED):
        clauses += [_random_rule(rng, name, list(DERIVED)[:at]) for _ in range(rng.randrange(1, 3))]
    return list(dict.fromkeys(clauses))


def base_of(clauses: list[str]) -> KnowledgeBase:
    """The knowledge base of a program."""
    return KnowledgeBase.from_text("\n".join([*(f":- dynamic({n}/{a})." for n, a in {**DERIVED, **GIVEN}.items()), *clauses]))


def in_order(term):
    """The term with all its lists sorted: SWI gives the answers as it finds them."""
    if not isinstance(term, Compound):
        return term
    items, tail = list_items(term)
    if items and tail == "[]":
        return make_list(sorted(map(in_order, items), key=standard_key))
    return Compound([in_order(part) for part in term])


def compare(count: int, seed: int, folder: Path) -> Tally:
    """Ask for all rows: what SWI-Prolog finds without an error has to be found, and nothing else, nor undefined.

    No list with repetitions is enumerated inside of an aggregate: a goal has each answer once here (docs/language.md).

    Lists of what was found are compared in any order, as SWI-Prolog's tables have none; those that rules make of
    sorted lists (``l/2``) exactly.
    """
    rng = random.Random(seed)
    programs = [[*random_program(rng), *random_list_rules(rng)] for _ in range(count)]
    tally = Tally(asked=count)
    found = answers(programs, {**DERIVED, "l": 2}, {**GIVEN, **HELPING}, folder)
    for program, (true, _, failed) in zip(programs, found, strict=True):
        if failed:  # what has no value is an error there, and ends the program
            tally.left += 1
            continue
        mine = _told(program)
        if mine == (set(map(in_order, (a for a in true if a[0] != "l"))), {a for a in true if a[0] == "l"}):
            tally.equal += 1
        else:
            tally.disagreements.append("\n".join([*program, f"we say: {mine}"]))
    return tally


def _told(program: list[str]) -> tuple[set[Compound], set[Compound]] | str:
    """The rows as we have them; a sentence where something is undefined or refused."""
    try:
        base = base_of(program)
        stored = {i: base.stored(i) for i in DERIVED.items()}
        if any(relation.undefined is not None for relation in stored.values()):
            return "something is undefined"
        listed = {Compound(("l", answer["X"], answer["Z"])) for answer in base.query("l(X, Z)")}
    except CasperError as mistake:
        return mistake.sentence
    return set(map(in_order, atoms_of(stored))), listed
