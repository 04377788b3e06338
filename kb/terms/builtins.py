"""The names of the built-in predicates: what a body may use though nobody defines it.

They are spelt as in SWI-Prolog. A program's own definition of one wins, as over a library's; the control predicates
alone cannot be redefined. What they do is in `kb.top_down.builtins`.
"""

from __future__ import annotations

from casper.kb.terms.clauses import Indicator

MOST_EXTRA = 7  # arguments that call/N adds to its goal
CONTROL: frozenset[Indicator] = frozenset({("true", 0), ("fail", 0), ("false", 0), ("not", 1), ("call", 1)})
KINDS = ("atom", "atomic", "callable", "compound", "float", "ground", "integer", "is_list", "nonvar", "number", "var")
BUILTINS: frozenset[Indicator] = CONTROL | frozenset(
    {
        *(("call", 1 + extra) for extra in range(1, MOST_EXTRA + 1)),
        *(("maplist", 1 + lists) for lists in (1, 2, 3)),
        *((kind, 1) for kind in KINDS),
        ("append", 3),
        ("atom_chars", 2),
        ("atom_codes", 2),
        ("atom_number", 2),
        ("char_code", 2),
        ("downcase_atom", 2),
        ("exclude", 3),
        ("foldl", 4),
        ("foldl", 5),
        ("include", 3),
        ("number_codes", 2),
        ("numlist", 3),
        ("partition", 4),
        ("plus", 3),
        ("sub_atom", 5),
        ("succ", 2),
        ("sumlist", 2),
        ("upcase_atom", 2),
        ("atom_concat", 3),
        ("atom_length", 2),
        ("between", 3),
        ("last", 2),
        ("length", 2),
        ("max_list", 2),
        ("member", 2),
        ("memberchk", 2),
        ("min_list", 2),
        ("msort", 2),
        ("nth0", 3),
        ("nth1", 3),
        ("reverse", 2),
        ("select", 3),
        ("sort", 2),
        ("sum_list", 2),
    }
)
