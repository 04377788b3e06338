"""Operators: the standard table (ISO, and what SWI-Prolog adds), and the tables of texts that declare their own."""

from __future__ import annotations

from dataclasses import dataclass, field

HIGHEST = 1200
ARGUMENT = 999  # the highest priority of an argument: above it a term needs brackets there
TYPES = ("xfx", "xfy", "yfx", "fy", "fx", "xf", "yf")
_STANDARD = {
    (1200, "xfx"): ":- --> =>",
    (1200, "fx"): ":- ?-",
    (1150, "fx"): (
        "dynamic discontiguous initialization meta_predicate module_transparent multifile public table thread_local"
        " thread_initialization volatile"
    ),
    (1105, "xfy"): "|",
    (1100, "xfy"): ";",
    (1050, "xfy"): "-> *->",
    (1000, "xfy"): ",",
    (800, "xfx"): ":=",
    (900, "fy"): "\\+",
    (700, "xfx"): "< = =.. =@= =:= =< == =\\= > >= @< @=< @> @>= \\= \\== \\=@= as is >:< :<",
    (600, "xfy"): ":",
    (500, "yfx"): "+ - /\\ \\/",
    (400, "yfx"): "* / // mod rem xor rdiv div << >>",
    (200, "xfx"): "**",
    (200, "xfy"): "^",
    (200, "fy"): "- + \\",
    (1, "fx"): "$",
}


@dataclass
class Operators:
    """A table of operators, as the reader looks them up.

    ``prefix`` and ``postfix`` give (priority, highest of the operand), ``infix`` (priority, highest left, highest
    right). ``own`` are the names that a text declared: a term with such an operator can be a statement.
    """

    prefix: dict[str, tuple[int, int]] = field(default_factory=dict)
    infix: dict[str, tuple[int, int, int]] = field(default_factory=dict)
    postfix: dict[str, tuple[int, int]] = field(default_factory=dict)
    own: set[str] = field(default_factory=set)

    def add(self, priority: int, type_: str, name: str) -> None:
        """Make a name an operator; with priority 0 it is none of that kind any more.

        Raises:
            ValueError: there is no such type, or the priority is not within 0 … 1200.
        """
        if type_ not in TYPES or not 0 <= priority <= HIGHEST:
            raise ValueError(f"no operator has priority {priority} and type {type_}")
        table: dict[str, tuple[int, int]] | dict[str, tuple[int, int, int]]
        sides = tuple(priority if side == "y" else priority - 1 for side in type_.replace("f", ""))
        table = self.infix if len(sides) == 2 else self.prefix if type_[0] == "f" else self.postfix
        if priority:
            table[name] = (priority, *sides)  # type: ignore[assignment]
        else:
            table.pop(name, None)

    def copy(self) -> Operators:
        """A table of its own that starts with what is in this one."""
        return Operators(dict(self.prefix), dict(self.infix), dict(self.postfix), set(self.own))

    def become(self, other: Operators) -> None:
        """Take over what is in another table."""
        self.prefix, self.infix, self.postfix = dict(other.prefix), dict(other.infix), dict(other.postfix)
        self.own = set(other.own)

    def __contains__(self, name: object) -> bool:
        return name in self.infix or name in self.prefix or name in self.postfix


def _standard() -> Operators:
    table = Operators()
    for (priority, type_), names in _STANDARD.items():
        for name in names.split():
            table.add(priority, type_, name)
    return table


STANDARD = _standard()
