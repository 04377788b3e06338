"""The model of a program: its analysis, its stored rows, and their upkeep as facts come and go."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, MutableMapping
from dataclasses import dataclass, field, replace
from functools import cached_property, partial
from threading import RLock

from casper.kb.bottom_up.changes import Change
from casper.kb.bottom_up.heights import Heights
from casper.kb.bottom_up.incremental import Maintenance, TooMuch
from casper.kb.bottom_up.materialise import materialise
from casper.kb.errors import ProgramError
from casper.kb.program.declarations import Moded
from casper.kb.program.program import Program, analyse
from casper.kb.reasons.constraints import ConstraintCode, Constraints, History, with_history
from casper.kb.relations.layered import LayeredRelation
from casper.kb.relations.relation import Relation, Row, copied
from casper.kb.store.layers import GivenLayer, Layers
from casper.kb.store.least_on_demand import Remembered, best_rows
from casper.kb.store.on_demand import check_storable, code_of, facts_key, facts_of, index, is_demanded, listed_of
from casper.kb.store.queries import MOST_REMEMBERED, Query, query_of
from casper.kb.terms.clauses import Clause, Indicator
from casper.kb.terms.origins import Origin
from casper.kb.terms.terms import Compound
from casper.kb.top_down.answering import Answering
from casper.kb.top_down.linking import Code, Computed, Links, Rows
from casper.kb.top_down.lookups import Lookups
from casper.kb.top_down.solve import DEFAULT_BUDGET

MOST_EXACT = 50_000  # rows up to which proofs are of least height whatever happened
MOST_LAYERS = 8  # laid over one another before their rows are put together again


class Compiled:
    """What depends on the rules alone, compiled when it is first needed and kept however the facts change."""

    def __init__(self, program: Program) -> None:
        self.program = program
        self.maintenance = Maintenance(program)

    @cached_property
    def constraints(self) -> ConstraintCode:
        """The constraints."""
        return ConstraintCode(self.program)

    @cached_property
    def heights(self) -> Heights:
        """What finds the least proof of every row."""
        return Heights(self.program)


@dataclass
class Model:
    """What is worked out of the clauses once, and kept in step afterwards.

    ``given`` are the base facts: for each stored predicate its rows, with what is behind each (None: loaded in bulk).
    """

    program: Program
    given: Mapping[Indicator, MutableMapping[Row, Origin]]
    facts: MutableMapping[Indicator, Relation]  # all that is at hand until the rows of the rules are listed
    computed: Mapping[Indicator, Computed]
    compiled: Compiled
    listed: MutableMapping[Indicator, Relation] | None = None
    changed: bool = False
    round: int = 1 << 40  # of the next change; later than any round of a fixpoint
    layers: int = 0  # how many models this one is laid over
    lock: RLock = field(default_factory=RLock)  # held while rows are listed: rows and code change at once
    queries: dict[str, Query] = field(default_factory=dict)  # those that were asked before, by their texts
    best: Remembered = field(default_factory=dict)  # rows of recursive minima, by what was asked of them
    _lookups: Lookups | None = None  # of the rows that are at hand

    @classmethod
    def of(
        cls,
        clauses: Iterable[Clause],
        dynamic: Iterable[Indicator],
        bulk: Mapping[Indicator, dict[Row, Origin]],
        computed: Mapping[Indicator, Computed],
        least: Mapping[Indicator, Moded] | None = None,
        stored: Collection[Indicator] = (),
        offered: Collection[Indicator] = (),
    ) -> Model:
        """Analyse, and list what follows from the facts where they are few, or where a ``stored`` predicate wants it.

        Raises:
            ProgramError, BudgetExceeded: see `kb.program.program.analyse` and `kb.bottom_up.materialise.materialise`.
        """
        program = analyse(clauses, dynamic, bulk, least, offered)
        for indicator in stored:
            check_storable(program, indicator)
        model = cls(program, program.given, {}, computed, Compiled(program))
        if is_demanded(program) and not listed_of(program) & set(stored):
            model.facts = facts_of(program)
            index(program, model.facts)
        else:
            _ = model.relations
        return model

    @property
    def relations(self) -> MutableMapping[Indicator, Relation]:
        """The rows of everything that can be listed; worked out when they are first asked for."""
        listed = self.listed
        if listed is not None:
            return listed
        with self.lock:
            if self.listed is None:
                try:
                    self.listed = materialise(replace(self.program, given=self.given))  # type: ignore[arg-type]
                except RecursionError:
                    raise ProgramError("the facts hold a term that is nested too deeply") from None
                self.facts = {}
            return self.listed

    @property
    def at_hand(self) -> MutableMapping[Indicator, Relation]:
        """The rows that are there now."""
        listed = self.listed
        if listed is not None:
            return listed
        with self.lock:
            return self.facts if self.listed is None else self.listed

    def query(self, goal: str) -> Query:
        """A query of text, read and checked once.

        Raises:
            ReadError, ProgramError: with the place of the mistake.
        """
        found = self.queries.get(goal)
        if found is None:
            if len(self.queries) >= MOST_REMEMBERED:
                self.queries.clear()
            found = self.queries[goal] = query_of(goal, self.program.clauses)
        return found

    def _at_hand(self) -> tuple[MutableMapping[Indicator, Relation], Code, bool]:
        """The rows that are there now, with the clauses that go with them, and whether that is all."""
        listed = self.listed
        if listed is not None:
            return listed, self.code, True
        with self.lock:
            if self.listed is None:
                return self.facts, self.demand_code, False
            return self.listed, self.code, True

    @property
    def links(self) -> Links:
        """How every predicate is answered just now."""
        relations, code, is_all = self._at_hand()
        return Links(relations, code, self.computed if is_all else self._with_best(self.computed))

    def search(
        self,
        history: History = (),
        budget: int = DEFAULT_BUDGET,
        computed: Mapping[Indicator, Computed] | None = None,
    ) -> Answering:
        """A fresh search over what is at hand; ``computed`` are the computed predicates, where they are not its own."""
        relations, code, is_all = self._at_hand()
        listed = None if is_all else partial(self.full_search, history, budget, computed)
        lookups = self._lookups
        if lookups is None or lookups.relations is not relations:
            lookups = self._lookups = Lookups(relations, code.query)
        seen = with_history(relations, history)
        asked = self.computed if computed is None else computed
        if not is_all:
            asked = self._with_best(asked)
        return Answering(seen, code.clauses, asked, budget, code=code, listed=listed, lookups=lookups)

    def _with_best(self, computed: Mapping[Indicator, Computed]) -> Mapping[Indicator, Computed]:
        """The computed predicates, and those whose best rows alone are kept: while they are not listed, as asked."""
        if not self.program.least:
            return computed
        return {**computed, **dict.fromkeys(self.program.least, Rows(self._best_of))}

    def _best_of(self, atom: Compound) -> Relation:
        asked = best_rows(atom, self.program, self.facts, self.best) if self.listed is None else None
        return self.relations[atom.indicator] if asked is None else asked

    def full_search(
        self,
        history: History = (),
        budget: int = DEFAULT_BUDGET,
        computed: Mapping[Indicator, Computed] | None = None,
    ) -> Answering:
        """A fresh search over everything that can be listed."""
        _ = self.relations
        return self.search(history, budget, computed)

    @cached_property
    def constraints(self) -> Constraints:
        """The constraints, those that the facts alone decide decided now."""
        return self.compiled.constraints.decided(self.full_search() if self.program.constraints else self.search())

    @cached_property
    def code(self) -> Code:
        """The clauses as searches run them over listed rows."""
        return Code(self.program.clauses)

    @cached_property
    def demand_code(self) -> Code:
        """The clauses as searches run them while only the facts are at hand."""
        return code_of(self.program, self.facts)

    @cached_property
    def proofs(self) -> Mapping[Indicator, Relation]:
        """The relations with the rounds that proofs are built from: least heights, where that costs little.

        A large base that has more than one stratum, or that changed, keeps its rounds as they are: its proofs are
        well-founded, but a shorter one may exist.
        """
        exact = len(self.program.strata) <= 1 and not self.changed and not (self.program.circular or self.program.least)
        if exact or sum(map(len, self.relations.values())) > MOST_EXACT:
            return self.relations
        return self.compiled.heights.of(self.given, self.relations)

    def keeps(self, indicator: Indicator) -> bool:
        """Whether facts of the predicate can come and go without a new analysis."""
        return indicator in self.program.rules and indicator not in self.program.top_down

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
        self.best.clear()
        self.__dict__.pop("constraints", None)
        self.__dict__.pop("proofs", None)
        if self.listed is None:
            facts = self.facts[facts_key(self.program, indicator)]
            if not len(facts):  # its rules alone were asked until now
                self.__dict__.pop("demand_code", None)
            return facts.add(row) if add else facts.remove(row)
        here: Change = {indicator: {row: None}}
        try:
            added, removed = (here, {}) if add else ({}, here)
            self.round = self.compiled.maintenance.update(self.given, self.listed, added, removed, self.round)
        except TooMuch:
            self._recompute()
        return True

    def _recompute(self) -> None:
        self.listed = materialise(replace(self.program, given=self.given))  # type: ignore[arg-type]

    def layer(self, computed: Mapping[Indicator, Computed]) -> Model:
        """A model laid over this one: what changes there leaves this one as it is."""
        with self.lock:
            given, facts = Layers(self.given, GivenLayer), Layers(self.facts, LayeredRelation)
            listed = None if self.listed is None else Layers(self.listed, LayeredRelation)
        kept = self.compiled, listed, self.changed, self.round
        return Model(self.program, given, facts, computed, *kept, self.layers + 1, queries=self.queries)

    def apart(self, computed: Mapping[Indicator, Computed]) -> Model:
        """The same model to be changed while somebody goes on reading this one."""
        if self.layers < MOST_LAYERS:
            return self.layer(computed)
        given: dict[Indicator, MutableMapping[Row, Origin]] = {i: dict(self.given[i]) for i in self.given}
        with self.lock:
            facts = {i: copied(self.facts[i]) for i in self.facts}
            listed = None if self.listed is None else {i: copied(self.listed[i]) for i in self.listed}
        kept = self.compiled, listed, self.changed, self.round
        return Model(self.program, given, facts, computed, *kept, queries=self.queries)
