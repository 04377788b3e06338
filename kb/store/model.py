"""The model of a program: its analysis, its stored rows, and their upkeep as facts come and go."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, MutableMapping
from dataclasses import dataclass, replace
from functools import cached_property

from casper.kb.bottom_up.heights import least_heights
from casper.kb.bottom_up.incremental import Change, Maintenance, TooMuch
from casper.kb.bottom_up.materialise import materialise
from casper.kb.errors import ProgramError
from casper.kb.program.declarations import Moded
from casper.kb.program.program import Program, analyse
from casper.kb.reasons.validity import Constraints, constraints_of
from casper.kb.relations.layered import LayeredRelation
from casper.kb.relations.relation import Relation, Row, copied
from casper.kb.terms.clauses import Clause, Indicator
from casper.kb.terms.origins import Origin
from casper.kb.top_down.solve import Computed, Solver

MOST_EXACT = 50_000  # rows up to which proofs are of least height whatever happened
MOST_LAYERS = 8  # laid over one another before their rows are put together again


@dataclass
class Model:
    """What is worked out of the clauses once, and kept in step afterwards.

    ``given`` are the base facts: for each stored predicate its rows, with what is behind each (None: loaded in bulk).
    """

    program: Program
    given: Mapping[Indicator, MutableMapping[Row, Origin]]
    relations: MutableMapping[Indicator, Relation]
    computed: Mapping[Indicator, Computed]
    maintenance: Maintenance
    changed: bool = False
    round: int = 1 << 40  # of the next change; later than any round of a fixpoint
    layers: int = 0  # how many models this one is laid over

    @classmethod
    def of(
        cls,
        clauses: Iterable[Clause],
        dynamic: Iterable[Indicator],
        bulk: Mapping[Indicator, dict[Row, Origin]],
        computed: Mapping[Indicator, Computed],
        least: Mapping[Indicator, Moded] | None = None,
    ) -> Model:
        """Analyse and materialise.

        Raises:
            ProgramError, BudgetExceeded: see `kb.program.program.analyse` and `kb.bottom_up.materialise.materialise`.
        """
        program = analyse(clauses, dynamic, bulk, least)
        try:
            relations = materialise(program)
        except RecursionError:
            raise ProgramError("the facts hold a term that is nested too deeply") from None
        return cls(program, program.given, relations, computed, Maintenance(program))

    @cached_property
    def constraints(self) -> Constraints:
        """The constraints, those that the facts alone decide decided now."""
        return constraints_of(self.program, Solver(self.relations, self.program.clauses, self.computed))

    @cached_property
    def proofs(self) -> Mapping[Indicator, Relation]:
        """The relations with the rounds that proofs are built from: least heights, where that costs little.

        A large base that has more than one stratum, or that changed, keeps its rounds as they are: its proofs are
        well-founded, but a shorter one may exist.
        """
        exact = len(self.program.strata) <= 1 and not self.changed and not (self.program.circular or self.program.least)
        if exact or sum(map(len, self.relations.values())) > MOST_EXACT:
            return self.relations
        return least_heights(replace(self.program, given=self.given), self.relations)  # type: ignore[arg-type]

    def keeps(self, indicator: Indicator) -> bool:
        """Whether facts of the predicate can come and go without a new analysis."""
        return indicator in self.relations

    def change(self, indicator: Indicator, row: Row, clause: Origin, *, add: bool) -> bool:
        """Give or take back a base fact and bring the rows in step; False when it changes nothing."""
        given = self.given[indicator]
        if (row in given) == add:
            return False
        if add:
            given[row] = clause
        else:
            del given[row]
        self.changed = True
        self.__dict__.pop("constraints", None)
        self.__dict__.pop("proofs", None)
        here: Change = {indicator: {row: None}}
        try:
            added, removed = (here, {}) if add else ({}, here)
            self.round = self.maintenance.update(self.given, self.relations, added, removed, self.round)
        except TooMuch:
            self._recompute()
        return True

    def _recompute(self) -> None:
        self.relations = materialise(replace(self.program, given=self.given))  # type: ignore[arg-type]

    def layer(self, computed: Mapping[Indicator, Computed]) -> Model:
        """A model laid over this one: what changes there leaves this one as it is."""
        given, relations = _Layers(self.given, _GivenLayer), _Layers(self.relations, LayeredRelation)
        above = self.layers + 1
        return Model(self.program, given, relations, computed, self.maintenance, self.changed, self.round, above)

    def apart(self, computed: Mapping[Indicator, Computed]) -> Model:
        """The same model to be changed while somebody goes on reading this one."""
        if self.layers < MOST_LAYERS:
            return self.layer(computed)
        given: dict[Indicator, MutableMapping[Row, Origin]] = {i: dict(self.given[i]) for i in self.given}
        relations = {i: copied(self.relations[i]) for i in self.relations}
        return Model(self.program, given, relations, computed, self.maintenance, self.changed, self.round)


class _Layers(dict):  # type: ignore[type-arg]
    """A mapping laid over another: an entry gets a layer of its own when it is first looked up."""

    def __init__(self, below: Mapping, layer: type) -> None:  # type: ignore[type-arg]
        super().__init__()
        self.below, self.layer = below, layer

    def __missing__(self, key: Indicator) -> object:
        return self.setdefault(key, self.layer(self.below[key]))  # of two threads that look, the first one's counts

    def get(self, key: Indicator, default: object = None) -> object:
        """The entry, through its layer."""
        try:
            return self[key]
        except KeyError:
            return default

    def __contains__(self, key: object) -> bool:
        return super().__contains__(key) or key in self.below

    def __iter__(self) -> Iterator[Indicator]:
        return iter(dict.fromkeys((*self.below, *super().__iter__())))

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def values(self) -> list[object]:  # type: ignore[override]
        """Every entry, through its layer."""
        return [self[key] for key in self]


class _GivenLayer(MutableMapping[Row, "Origin"]):
    """Base facts laid over others."""

    def __init__(self, below: Mapping[Row, Origin]) -> None:
        self.below = below
        self.above: dict[Row, Origin] = {}
        self.gone: set[Row] = set()

    def __contains__(self, row: object) -> bool:
        return row in self.above or (row in self.below and row not in self.gone)

    def __getitem__(self, row: Row) -> Origin:
        if row in self.above:
            return self.above[row]
        if row in self.gone:
            raise KeyError(row)
        return self.below[row]

    def __setitem__(self, row: Row, clause: Origin) -> None:
        self.above[row] = clause

    def __delitem__(self, row: Row) -> None:
        self.above.pop(row, None)
        self.gone.add(row)

    def __iter__(self) -> Iterator[Row]:
        yield from (row for row in self.below if row not in self.gone and row not in self.above)
        yield from self.above

    def __len__(self) -> int:
        return sum(1 for _ in self)
