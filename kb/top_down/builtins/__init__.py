"""The built-in predicates: each a name with what computes it, or with clauses of its own.

In: a call's arguments. Out: the values they can take. `COMPUTING` are functions, `CONTROL` goals about goals, `library`
clauses. Names that programs may use are listed in `kb.terms.builtins`.
"""

from casper.kb.top_down.builtins.atoms import ATOMS
from casper.kb.top_down.builtins.builtin import Builtin
from casper.kb.top_down.builtins.characters import CHARACTERS
from casper.kb.top_down.builtins.clauses import library
from casper.kb.top_down.builtins.control import CONTROL
from casper.kb.top_down.builtins.kinds import KINDS
from casper.kb.top_down.builtins.lists import LISTS
from casper.kb.top_down.builtins.numbers import NUMBERS

COMPUTING = {**ATOMS, **CHARACTERS, **KINDS, **LISTS, **NUMBERS}

__all__ = ["COMPUTING", "CONTROL", "Builtin", "library"]
