"""Goals inside goals: a clause with ``\\+ (a, b)``, ``(C -> T ; E)``, ``forall`` or an aggregate, as plain clauses.

Alternatives become clauses of their own. A goal that is negated or counted as a whole becomes an auxiliary predicate,
whose arguments are what it shares with the rest of the clause (when it is counted: all its variables, so that every
answer counts once). Evaluation, reasons and upkeep then know of literals only.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence, Set
from dataclasses import dataclass, field
from itertools import product
from math import prod

from casper.kb.errors import Place, ProgramError
from casper.kb.program.listing import is_range_restricted
from casper.kb.terms.builtins import BUILTINS
from casper.kb.terms.clauses import AGGREGATE, AUXILIARY, Clause, Literal
from casper.kb.terms.control import CONTROL
from casper.kb.terms.syntax import COMPARISONS, term_text
from casper.kb.terms.terms import Compound, Term, Variable, as_term, predication
from casper.kb.terms.unification import Bindings, is_ground, substitute, variables_of
from casper.kb.terms.values.aggregates import check_way
from casper.kb.text.sentences import MOST_ALTERNATIVES, TOO_MANY

_FAILS = Compound(("=", "true", "fail"))


def plain_clauses(clauses: Iterable[Clause], prefix: str = "") -> Iterator[Clause]:
    """The clauses without control in their bodies, each followed by the auxiliary ones it needs.

    Raises:
        ProgramError: something stands where a goal is needed, or an aggregate is none.
    """
    plain = _Plain(prefix)
    for clause in clauses:
        if any(is_control(literal) for literal in clause.body):
            yield from plain.clause(clause)
            yield from plain.taken()
        else:
            yield clause


def plain_query(body: Sequence[Literal], prefix: str) -> tuple[list[tuple[Literal, ...]], list[Clause]]:
    """The alternatives of a query without control in them, and the auxiliary clauses they need."""
    if not any(map(is_control, body)):
        return [tuple(body)], []
    plain = _Plain(prefix, is_question=True)
    asked = Clause(Compound(("asked", *dict.fromkeys(v for x in body for v in x.variables()))), tuple(body))
    found = list(plain.clause(asked, frozenset()))
    return [clause.body for clause in found], list(plain.taken())


def is_control(literal: Literal) -> bool:
    """Whether a condition is made of other conditions."""
    name, size = literal.atom[0], len(literal.atom)
    if name == "call" and size > 1:
        return not isinstance(literal.atom[1], Variable)
    return literal.atom.indicator in CONTROL


@dataclass
class _Plain:
    prefix: str
    made: list[Clause] = field(default_factory=list)
    count: int = 0
    is_question: bool = False  # then what is counted is tabled once, not looked up row by row on its budget

    def taken(self) -> list[Clause]:
        """The auxiliary clauses since the last time, themselves plain."""
        found, self.made = self.made, []
        return found

    def clause(
        self, clause: Clause, outer: frozenset[Variable] | None = None, around: Sequence[Literal] = ()
    ) -> Iterator[Clause]:
        """The clauses that say the same.

        Args:
            outer: the variables bound before the body (None: the head's).
            around: the conditions among which the clause is asked.
        """
        for body in _combined([_alternatives(x.atom, x.negated, x.place) for x in clause.body], clause.place):
            leaves = [leaf for part in body for leaf in part]
            before = set(variables_of(clause.head)) if outer is None else set(outer)
            literals = []
            for at, leaf in enumerate(leaves):
                others = [x for i, x in enumerate(leaves) if i != at]
                literals.append(self._literal(leaf, clause.head, others, before, around))
                before |= _answered([[leaf]])
            yield Clause(clause.head, tuple(literals), clause.place)

    def _literal(
        self,
        leaf: Literal,
        head: Compound,
        others: list[Literal],
        before: set[Variable],
        around: Sequence[Literal],
    ) -> Literal:
        if leaf.atom.indicator in _AGGREGATES:
            return self._aggregate(leaf, before, [*others, *around])
        if leaf.negated and is_control(leaf):
            return self._absence(leaf, head, others, around)
        return leaf

    def _absence(self, leaf: Literal, head: Compound, others: list[Literal], around: Sequence[Literal]) -> Literal:
        elsewhere = set(variables_of(head, *(_shown(x) for x in others)))
        shared = [v for v in variables_of(leaf.atom) if v in elsewhere]
        atom = self._auxiliary(leaf.atom, shared, set(shared), leaf.place, [*others, *around])
        return Literal(atom, True, leaf.place, as_term(leaf.atom))

    def _aggregate(self, leaf: Literal, before: set[Variable], around: list[Literal]) -> Literal:
        what, goal, result = _parts(leaf)
        shown = Compound((AGGREGATE, what, goal, result)) if leaf.atom[0] == AGGREGATE else leaf.atom
        inner = predication(goal)
        open_ = before | set(variables_of(what)) | _answered(_alternatives(inner, False, leaf.place))
        arguments = [v for v in variables_of(inner, what) if v in open_]
        if not self.is_question and _is_plain(inner) and [arg for arg in inner.args if not is_ground(arg)] == arguments:
            atom = inner  # different variables and constants: its rows are those of the auxiliary predicate
        else:
            atom = self._auxiliary(inner, arguments, set(variables_of(what)) | before, leaf.place, around)
        own: Bindings = {}
        for variable in arguments:
            if variable not in before:  # as in Prolog it is the goal's own, whatever comes later
                self.count += 1
                own[variable] = Variable(f"_#of{self.count}")
        counted = Compound((AGGREGATE, substitute(what, own), substitute(atom, own), result))
        return Literal(counted, False, leaf.place, shown)

    def _auxiliary(
        self, goal: Compound, arguments: list[Variable], wanted: Set[Variable], place: Place, around: list[Literal]
    ) -> Compound:
        """An atom that holds as often as the goal does, of a predicate made for it."""
        self.count += 1
        name = f"{AUXILIARY}{self.prefix}{self.count}"
        bodies = _alternatives(goal, False, place)
        tagged = len(bodies) > 1
        for number, body in enumerate(bodies):
            bound = set(variables_of(*(x.atom for x in body)))
            own = {v: "-" for v in arguments if v not in bound and v not in wanted}
            head = Compound((name, *([number] if tagged else ()), *(own.get(v, v) for v in arguments)))
            for clause in self.clause(Clause(head, tuple(body), place), None, around):
                self.made.append(_guarded(clause, around))
        tag = [Variable(f"_#tag{self.count}")] if tagged else []
        return Compound((name, *tag, *arguments))


def _shown(leaf: Literal) -> Term:
    """What a condition shows of itself to the others: of an aggregate its result, the rest is its own."""
    return leaf.atom[3] if leaf.atom.indicator in _AGGREGATES else leaf.atom


def _is_plain(goal: Compound) -> bool:
    """Whether a goal is one condition that is looked up among the rows of a predicate."""
    name, arity = goal.indicator
    control = is_control(Literal(goal)) or name in (",", ";", ":", "!", "call", "true", "fail", "false")
    return not control and goal.indicator not in BUILTINS and not (name in COMPARISONS and arity == 2)


def _answered(bodies: Iterable[Sequence[Literal]]) -> set[Variable]:
    """The variables that tell the answers of a goal apart: not those inside its negations and aggregates."""
    found: set[Variable] = set()
    for leaf in (leaf for body in bodies for leaf in body):
        if not leaf.negated:
            found.update(variables_of(_shown(leaf)))
    return found


def _guarded(clause: Clause, others: Sequence[Literal]) -> Clause:
    """The clause with conditions from around it that bind what it does not: it is only asked where they hold."""
    guards: list[Literal] = []
    for literal in others:
        if is_range_restricted(_with(clause, guards)):
            break
        if not (literal.negated or literal.is_comparison or is_control(literal)):
            guards.append(literal)
    guarded = _with(clause, guards)
    return guarded if is_range_restricted(guarded) else clause


def _with(clause: Clause, guards: Sequence[Literal]) -> Clause:
    """The clause with more conditions before its own."""
    return Clause(clause.head, (*guards, *clause.body), clause.place)


_AGGREGATES = ((AGGREGATE, 3), ("findall", 3))


def _parts(leaf: Literal) -> tuple[Term, Term, Term]:
    """What is worked out, of which goal, and the result.

    Raises:
        ProgramError: it is no way to put answers together, or the goal is a variable.
    """
    what, goal, result = leaf.atom.args
    if leaf.atom[0] == "findall":
        what = Compound(("bag", what))
    place = leaf.place if leaf.place.line else None
    check_way(what, place)
    if not isinstance(goal, (str, Compound)):
        raise ProgramError(f"{leaf.atom[0]} needs a goal, not {term_text(goal)}", place)
    return what, goal, result


def _alternatives(goal: Compound, negated: bool, place: Place) -> list[list[Literal]]:
    """A goal as alternatives of conditions, in the author's order; what is negated or counted as a whole stays one."""
    name, args = goal.functor, goal.args
    if name == "call" and args and not isinstance(args[0], Variable):
        return _alternatives(_called(goal, place), negated, place)
    if name in ("\\+", "not") and len(args) == 1:
        return _alternatives(_goal(args[0], place), not negated, place)
    if (name in ("true", "fail", "false")) and not args:
        return [[]] if (name == "true") is not negated else [[Literal(_FAILS, False, place, name)]]
    if name == "forall" and len(args) == 2:
        exception = Compound((",", args[0], Compound(("\\+", args[1]))))
        return [[Literal(exception, True, place, as_term(goal))]] if not negated else _inside_out(exception, place)
    if name == ";" and args:
        return _either(args, negated, place)
    if name in (",", "->") and args:
        if negated:
            return [[Literal(goal, True, place)]]
        parts = [_alternatives(_goal(arg, place), False, place) for arg in args]
        return [[leaf for part in choice for leaf in part] for choice in _combined(parts, place)]
    if goal.indicator in _AGGREGATES and negated:
        return [[Literal(Compound((",", goal)), True, place)]]
    return [[Literal(goal, negated, place)]]


def _combined(parts: Sequence[list[list[Literal]]], place: Place) -> Iterator[tuple[list[Literal], ...]]:
    """Every choice of one alternative of each part.

    Raises:
        ProgramError: there are too many of them.
    """
    if prod(map(len, parts)) > MOST_ALTERNATIVES:
        raise ProgramError(TOO_MANY, place if place.line else None)
    return product(*parts)


def _called(goal: Compound, place: Place) -> Compound:
    """The goal that ``call(G, X, …)`` calls.

    Raises:
        ProgramError: it is a number, or takes no more arguments.
    """
    inner, extra = _goal(goal[1], place), goal.args[1:]
    if extra and (is_control(Literal(inner)) or inner.functor in (",", ";")):
        sentence = f"{term_text(goal)}: what is called is a whole goal and takes no more arguments; name it by a rule"
        raise ProgramError(sentence, place if place.line else None)
    return Compound((*inner, *extra))


def _inside_out(goal: Compound, place: Place) -> list[list[Literal]]:
    """A goal that has an answer: asked once, however many it has."""
    return [[Literal(Compound((",", Compound(("\\+", goal)))), True, place)]]


def _either(args: Sequence[Term], negated: bool, place: Place) -> list[list[Literal]]:
    first, rest = args[0], args[1:]
    if not rest:
        return _alternatives(_goal(first, place), negated, place)
    otherwise = rest[0] if len(rest) == 1 else Compound((";", *rest))
    if negated:
        return [[Literal(Compound((";", *args)), True, place)]]
    if isinstance(first, Compound) and first.indicator == ("->", 2):
        then = _alternatives(Compound((",", first[1], first[2])), False, place)
        return then + _alternatives(Compound((",", Compound(("\\+", _own(first[1]))), otherwise)), False, place)
    return [body for arg in args for body in _alternatives(_goal(arg, place), False, place)]


def _own(condition: Term) -> Term:
    """The condition as one goal: under its negation its variables are its own."""
    return Compound((",", condition))


def _goal(term: Term, place: Place) -> Compound:
    """The term as a goal.

    Raises:
        ProgramError: it is a number or a variable.
    """
    try:
        return predication(term)
    except TypeError:
        raise ProgramError(f"{term_text(term)} cannot stand where a goal is needed", place) from None
