"""Answers as columns: numpy arrays by the names of a query's variables, and on to pandas and Arrow."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from casper.kb.errors import BudgetExceeded, CasperError
from casper.kb.relations.column_relation import ColumnRelation
from casper.kb.relations.columns import Ids
from casper.kb.relations.constants import typed as typed
from casper.kb.relations.relation import Relation
from casper.kb.relations.tables.joins import Join, Solutions
from casper.kb.relations.tables.libraries import needed
from casper.kb.relations.tables.masks import Values
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import is_ground

if TYPE_CHECKING:
    import pandas
    import pyarrow

Column = NDArray[Any]
MOST_VALUES = 30_000_000  # in one table: 240 MB as numbers
_DEARER = 10  # times what a value takes in a Python row


@dataclass(frozen=True, eq=False)
class Answers:
    """The answers to a query, each once.

    ``columns`` maps each named variable, in order, to an array of shape (answers,): ``int64`` where all values are
    whole numbers, ``float64`` where all are numbers, otherwise Python objects (an atom is its string, the same object
    for every row that has it). Iteration gives the answers as tuples of Python values.
    """

    columns: Mapping[str, Column]
    size: int

    def __len__(self) -> int:
        return self.size

    def __iter__(self) -> Iterator[tuple[Term, ...]]:
        if not self.columns:
            return iter([()] * self.size)
        return zip(*(column.tolist() for column in self.columns.values()))

    def to_pandas(self) -> pandas.DataFrame:
        """A data frame with a column for each variable.

        Raises:
            CasperError: pandas is not installed.
        """
        frame: pandas.DataFrame = needed("pandas").DataFrame(dict(self.columns), index=range(self.size))
        return frame

    def to_arrow(self) -> pyarrow.Table:
        """An Arrow table with a column for each variable: whole numbers, numbers, or strings.

        Raises:
            CasperError: pyarrow is not installed, or a column is neither all numbers nor all atoms.
        """
        arrow = needed("pyarrow")
        arrays = {name: arrow.array(_arrow_values(name, column)) for name, column in self.columns.items()}
        table: pyarrow.Table = arrow.table(arrays)
        return table


def _arrow_values(name: str, column: Column) -> Column:
    if column.dtype == object and any(type(value) is not str for value in column.tolist()):
        what = "terms, unknown parts, or atoms and numbers"
        raise CasperError(f"column {name} holds {what}, for which Arrow has no one type; use to_pandas() or columns")
    return column


def of_answers(names: Sequence[str], answers: Iterable[Mapping[str, Term]]) -> Answers:
    """Answers one by one as columns; a part that some answer leaves open is a `Variable`.

    Raises:
        BudgetExceeded: there are too many.
    """
    most = MOST_VALUES // (_DEARER * max(len(names), 1))
    rows: dict[tuple[Term, ...], None] = {}
    for answer in answers:
        rows[tuple([answer.get(name, Variable(name)) for name in names])] = None
        if len(rows) > most:
            raise _too_many(most)
    return _of_rows(names, list(rows))


def of_join(join: Join, look: Callable[[], object]) -> Answers:
    """The answers to a question that is worked out on columns; ``look`` is called now and then.

    Raises:
        NotOnColumns: it cannot be. BudgetExceeded: there are too many answers.
    """
    solutions, size = Solutions(join), 0
    blocks: list[list[Any]] = []  # of columns
    most = MOST_VALUES // len(join.names)
    for columns in solutions:
        look()
        size += len(columns[0].array if isinstance(columns[0], Values) else columns[0])
        if size > most:
            raise _too_many(most)
        blocks.append([*columns])
    found: dict[str, Column] = {}
    for at, name in enumerate(join.names):
        parts = [block[at] for block in blocks]
        for block in blocks:
            block[at] = None  # each column is let go as soon as the answers have it
        found[name.name] = _joined(parts, solutions)
    return Answers(found, size)


def _joined(parts: list[Any], solutions: Solutions) -> Column:
    """The blocks of one column as an array."""
    if not parts:
        return np.empty(0, dtype=object)
    if isinstance(parts[0], Values):
        return np.concatenate([part.array for part in parts])
    return solutions.constants.typed(np.concatenate(parts))


def _too_many(most: int) -> BudgetExceeded:
    hint = "kb.query(…) gives them one by one"
    return BudgetExceeded(f"there are more than {most:,} answers, too many for one table; {hint}, or ask for less")


def of_stored(atom: Compound, relation: Relation) -> Answers | None:
    """The rows of a stored relation that an atom of constants and variables can be; None for any other atom.

    Rows that are columns of interned constants stay columns: none is made a Python tuple.
    """
    if not all(isinstance(arg, Variable) or is_ground(arg) for arg in atom.args):
        return None
    named = {v.name: at for at, v in reversed(list(enumerate(atom.args))) if _is_named(v)}
    kept = dict(sorted(named.items(), key=lambda item: item[1]))  # each at its first place
    interned = relation.interned() if isinstance(relation, ColumnRelation) else None
    if interned is None:
        return _of_rows(list(kept), _matching_rows(atom, relation, list(kept.values())))
    return _of_numbers(atom, kept, *interned, len(relation))


def _is_named(arg: Term) -> bool:
    return isinstance(arg, Variable) and not arg.name.startswith("_")


def _matching_rows(atom: Compound, relation: Relation, kept: Sequence[int]) -> list[tuple[Term, ...]]:
    bound = tuple([at for at, arg in enumerate(atom.args) if not isinstance(arg, Variable)])
    same = _repeated(atom)
    rows = relation.matching(bound, tuple([atom.args[at] for at in bound]))
    found = (row for row in rows if all(row[a] == row[b] for a, b in same)) if same else rows
    if len(kept) == len(atom.args):
        return list(found)
    return list(dict.fromkeys(tuple([row[at] for at in kept]) for row in found))


def _repeated(atom: Compound) -> list[tuple[int, int]]:
    """Pairs of places that have the same variable."""
    first: dict[Term, int] = {}
    pairs = [(first.setdefault(arg, at), at) for at, arg in enumerate(atom.args) if isinstance(arg, Variable)]
    return [(a, b) for a, b in pairs if a != b]


def _of_numbers(
    atom: Compound, kept: Mapping[str, int], columns: Sequence[Ids], constants: Sequence[Term], size: int
) -> Answers:
    """The same on columns of numbers: masks instead of rows."""
    keep = np.ones(size, dtype=bool)
    numbers = {constant: number for number, constant in enumerate(constants)} if _has_constant(atom) else {}
    for at, arg in enumerate(atom.args):
        if not isinstance(arg, Variable):
            keep &= columns[at] == numbers.get(arg, -1)
    for a, b in _repeated(atom):
        keep &= columns[a] == columns[b]
    found = [columns[at][keep] for at in kept.values()]
    count = int(keep.sum())
    if not found:
        return Answers({}, min(count, 1))
    if len({arg for arg in atom.args if isinstance(arg, Variable)}) > len(kept):
        found = list(np.unique(np.stack(found), axis=1))
        count = len(found[0])
    return Answers({name: _decoded(column, constants) for name, column in zip(kept, found)}, count)


def _has_constant(atom: Compound) -> bool:
    return not all(isinstance(arg, Variable) for arg in atom.args)


def _decoded(column: Ids, constants: Sequence[Term]) -> Column:
    used = np.flatnonzero(np.bincount(column, minlength=len(constants)))
    places = np.empty(len(constants), np.int64)
    places[used] = np.arange(len(used))
    taken: Column = typed([constants[number] for number in used.tolist()])[places[column]]
    return taken


def _of_rows(names: Sequence[str], rows: Sequence[tuple[Term, ...]]) -> Answers:
    values = zip(*rows) if rows else [()] * len(names)
    return Answers({name: typed(column) for name, column in zip(names, values)}, len(rows))
