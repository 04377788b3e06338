"""The well-founded model of a ground program in near-linear time: propagation, and unfounded sets where it stops.

An atom holds once a rule's conditions are all settled in its favour; it is false once no rule is left for it. Where
neither settles more, atoms that could only rest on one another (a positive loop without support) are false together.
What is left is undefined. `alternating.alternate` is the plain version.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence

from casper.kb.bottom_up.join import Join
from casper.kb.bottom_up.steps import Binder, row_builder
from casper.kb.relations.relation import Relation, Row
from casper.kb.relations.undefined import UndefinedRows
from casper.kb.terms.clauses import Clause, Indicator, Literal
from casper.kb.terms.terms import Compound, Term, Variable
from casper.kb.terms.unification import variables_of

UNDECIDED, TRUE, FALSE = 0, 1, 2


class Ground:
    """Ground rules over numbered atoms; an atom's height is that of its proof, negations being settled."""

    def __init__(self) -> None:
        self.numbers: dict[tuple[Indicator, Row], int] = {}
        self.value: list[int] = []
        self.height: list[int] = []
        self.heads: list[int] = []
        self.premises: list[list[int]] = []
        self.waiting: list[int] = []  # conditions of each rule that are not settled in its favour
        self.dead: set[int] = set()  # rules that give nothing: a condition is settled against them
        self.left: list[int] = []  # rules of each atom that may still give it
        self.needing: list[list[int]] = []  # rules that need the atom
        self.denying: list[list[int]] = []  # rules that need its absence
        self.settled: list[int] = []

    def number(self, atom: tuple[Indicator, Row]) -> int:
        """The number of an atom, a new one if need be."""
        found = self.numbers.setdefault(atom, len(self.value))
        if found == len(self.value):
            self.value.append(UNDECIDED)
            self.height.append(0)
            self.left.append(0)
            self.needing.append([])
            self.denying.append([])
        return found

    def add(self, head: int, needed: list[int], denied: list[int]) -> None:
        """Add a rule: the head holds when all that is needed does and nothing that is denied."""
        rule = len(self.heads)
        self.heads.append(head)
        self.premises.append(needed)
        self.waiting.append(len(needed) + len(denied))
        self.left[head] += 1
        for atom in needed:
            self.needing[atom].append(rule)
        for atom in denied:
            self.denying[atom].append(rule)

    def state_true(self, atom: int, height: int) -> None:
        """Settle an atom as true; what follows is worked out by `run`."""
        if self.value[atom] == UNDECIDED:
            self.value[atom], self.height[atom] = TRUE, height
            self.settled.append(atom)

    def run(self) -> None:
        """Settle all that can be."""
        for rule, waiting in enumerate(self.waiting):
            if not waiting:
                self._fire(rule)
        for atom, left in enumerate(self.left):
            if not left:
                self._state_false(atom)
        while self._propagate() or self._unfounded():
            pass

    def _state_false(self, atom: int) -> None:
        if self.value[atom] == UNDECIDED:
            self.value[atom] = FALSE
            self.settled.append(atom)

    def _propagate(self) -> bool:
        """Follow what was settled; whether there was anything."""
        some = bool(self.settled)
        while self.settled:
            atom = self.settled.pop()
            holds = self.value[atom] == TRUE
            for rule in self.needing[atom] if holds else self.denying[atom]:
                self.waiting[rule] -= 1
                if not self.waiting[rule]:
                    self._fire(rule)
            for rule in self.denying[atom] if holds else self.needing[atom]:
                self._kill(rule)
        return some

    def _fire(self, rule: int) -> None:
        height = 1 + max((self.height[atom] for atom in self.premises[rule]), default=0)
        self.state_true(self.heads[rule], height)

    def _kill(self, rule: int) -> None:
        if rule not in self.dead:
            self.dead.add(rule)
            head = self.heads[rule]
            self.left[head] -= 1
            if not self.left[head]:
                self._state_false(head)

    def _unfounded(self) -> bool:
        """Make false what could only rest on itself; whether there was anything."""
        open_rules = [r for r, head in enumerate(self.heads) if self.value[head] == UNDECIDED and r not in self.dead]
        missing = {r: sum(self.value[a] == UNDECIDED for a in self.premises[r]) for r in open_rules}
        if not any(missing.values()):
            return False
        founded = {self.heads[rule] for rule in open_rules if not missing[rule]}
        waiting = list(founded)
        while waiting:
            for rule in self.needing[waiting.pop()]:
                if missing.get(rule):
                    missing[rule] -= 1
                    if not missing[rule] and self.heads[rule] not in founded:
                        founded.add(self.heads[rule])
                        waiting.append(self.heads[rule])
        for atom in {self.heads[rule] for rule in open_rules} - founded:
            self._state_false(atom)
        return bool(self.settled)


def settle(
    rules: Sequence[Clause], certain: dict[Indicator, Relation], possible: Mapping[Indicator, Relation], round_: int
) -> int:
    """Fill relations that hold what is given with what holds and what is undefined; the last round's number.

    Args:
        rules: of the stratum.
        certain: the stratum's relations.
        possible: everything that can hold at all, the stratum's own included; nothing below is undefined.
        round_: rounds of rows are later.
    """
    ground = Ground()
    for indicator, relation in certain.items():
        for row in relation.rows:
            ground.state_true(ground.number((indicator, row)), 0)
    for rule in rules:
        _instantiate(rule, frozenset(certain), possible, ground)
    ground.run()
    last = round_
    for (indicator, row), number in ground.numbers.items():
        relation = certain[indicator]
        if ground.value[number] == TRUE:
            relation.add(row, round_ + ground.height[number])
            last = max(last, round_ + ground.height[number])
        elif ground.value[number] == UNDECIDED:
            if relation.undefined is None:
                relation.undefined = UndefinedRows(*indicator)
            relation.undefined.add(row)
    return last


def _instantiate(
    rule: Clause, stratum: frozenset[Indicator], possible: Mapping[Indicator, Relation], ground: Ground
) -> None:
    """Add every instance of a rule whose conditions are possible; those below the stratum are settled by that."""
    positive = [x.atom for x in rule.body if x.needed in stratum and not x.negated]
    negative = [x for x in rule.body if x.needed in stratum and x.negated]
    kept = tuple(x for x in rule.body if x not in negative)
    named = [v for v in variables_of(rule.head, *positive, *(x.atom for x in negative))]
    bound = set(variables_of(rule.head, *(x.atom for x in kept)))
    known = [v for v in named if v in bound]
    slots = {variable: at for at, variable in enumerate(known)}
    head, build_head = rule.head.indicator, row_builder(list(rule.head.args), slots)
    premises = [(atom.indicator, row_builder(list(atom.args), slots)) for atom in positive]
    absences = [_absence(literal, slots, possible[literal.atom.indicator]) for literal in negative]

    def emit(row: Row) -> None:
        values = list(row)
        needed = [ground.number((indicator, build(values))) for indicator, build in premises]
        denied = [ground.number(atom) for rows in absences for atom in rows(values)]
        ground.add(ground.number((head, build_head(values))), needed, denied)

    Join(Clause(Compound(("instance", *known)), kept)).run(possible, (), emit)


def _absence(
    literal: Literal, slots: Mapping[Variable, int], relation: Relation
) -> Callable[[list[Term]], Iterator[tuple[Indicator, Row]]]:
    """What a negated condition denies: the rows with its known columns; the others are wildcards."""
    args, extended = literal.atom.args, dict(slots)
    for variable in literal.variables():
        extended.setdefault(variable, len(extended))
    columns = tuple(c for c, arg in enumerate(args) if all(v in slots for v in variables_of(arg)))
    key = row_builder([args[c] for c in columns], extended)
    fits = Binder([(c, arg) for c, arg in enumerate(args) if c not in columns], slots.keys(), extended)

    def rows(values: list[Term]) -> Iterator[tuple[Indicator, Row]]:
        environment = [*values, *[None] * (len(extended) - len(values))]
        for row in relation.matching(columns, key(environment)):
            if fits(row, environment):
                yield literal.atom.indicator, row

    return rows
