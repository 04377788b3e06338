"""SWRL's built-ins as conditions: comparisons, arithmetic, and the strings as far as the language speaks of them."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce

from casper.kb.ontologies.meaning.data_ranges import Body
from casper.kb.ontologies.vocabulary.refusals import Beyond
from casper.kb.ontologies.vocabulary.scope import Scope, literal
from casper.kb.ontologies.vocabulary.spoken import speaks
from casper.kb.terms.clauses import Literal
from casper.kb.terms.terms import Compound, Term, Variable

_COMPARED = {
    "equal": "=",
    "notEqual": "\\=",
    "lessThan": "<",
    "lessThanOrEqual": "=<",
    "greaterThan": ">",
    "greaterThanOrEqual": ">=",
}
ORDERING = ("lessThan", "lessThanOrEqual", "greaterThan", "greaterThanOrEqual")
_Computed = Callable[[Sequence[Term]], Term]
# How many arguments (None: two or more), what is made of them, and a trial with its result.
_COMPUTED: dict[str, tuple[int | None, _Computed, str, float]] = {}
_Spelt = Callable[[Sequence[Term], Scope], Body]


def _chained(operator: str) -> _Computed:
    return lambda args: reduce(lambda left, right: Compound((operator, left, right)), args)


def _applied(functor: str) -> _Computed:
    return lambda args: Compound((functor, *args))


_COMPUTED.update(
    {
        "add": (None, _chained("+"), "R is 7 + 2", 9),
        "subtract": (2, _chained("-"), "R is 7 - 2", 5),
        "multiply": (None, _chained("*"), "R is 7 * 2", 14),
        "divide": (2, _chained("/"), "R is 7 / 2", 3.5),
        "unaryPlus": (1, lambda args: Compound(("+", args[0], 0)), "R is 7 + 0", 7),
        "unaryMinus": (1, lambda args: Compound(("-", 0, args[0])), "R is 0 - 7", -7),
        "integerDivide": (2, _chained("//"), "R is -7 // 2", -3),
        "mod": (2, _chained("rem"), "R is -7 rem 2", -1),
        "pow": (2, _chained("**"), "R is 7 ** 2", 49),
        "abs": (1, _applied("abs"), "R is abs(-7)", 7),
        "ceiling": (1, _applied("ceiling"), "R is ceiling(6.5)", 7),
        "floor": (1, _applied("floor"), "R is floor(7.5)", 7),
        "round": (1, lambda args: Compound(("floor", Compound(("+", args[0], 0.5)))), "R is floor(-2.5 + 0.5)", -2),
        "sin": (1, _applied("sin"), "R is sin(0)", 0),
        "cos": (1, _applied("cos"), "R is cos(0)", 1),
        "tan": (1, _applied("tan"), "R is tan(0)", 0),
    }
)


def _concatenated(args: Sequence[Term], scope: Scope) -> Body:
    whole, first, *rest = args
    found: list[Literal] = []
    for at, part in enumerate(rest):
        joined = whole if at == len(rest) - 1 else scope.fresh(data=True)
        found.append(literal("atom_concat", first, part, joined))
        first = joined
    return tuple(found)


def _lower(text: Term, scope: Scope) -> tuple[Variable, Literal]:
    plain = scope.fresh(data=True)
    return plain, literal("downcase_atom", text, plain)


def _alike(args: Sequence[Term], scope: Scope) -> Body:
    (one, first), (other, second) = (_lower(arg, scope) for arg in args)
    return first, second, literal("=", one, other)


def _sub(before: Term, after: Term, args: Sequence[Term]) -> Body:
    return (literal("sub_atom", args[0], before, Variable("_#1"), after, args[1]),)


_SPELT: dict[str, tuple[int | None, _Spelt, str, str | int | None]] = {
    "stringConcat": (None, _concatenated, "atom_concat(to, day, R)", "today"),
    "stringLength": (2, lambda a, _: (literal("atom_length", a[1], a[0]),), "atom_length(today, R)", 5),
    "upperCase": (2, lambda a, _: (literal("upcase_atom", a[1], a[0]),), "upcase_atom(today, R)", "TODAY"),
    "lowerCase": (2, lambda a, _: (literal("downcase_atom", a[1], a[0]),), "downcase_atom('Today', R)", "today"),
    "stringEqualIgnoreCase": (2, _alike, "downcase_atom('Today', R)", "today"),
    "contains": (2, lambda a, _: _sub(Variable("_#2"), Variable("_#3"), a), "sub_atom(today, _, _, _, day), R = 1", 1),
    "startsWith": (2, lambda a, _: _sub(0, Variable("_#3"), a), "sub_atom(today, 0, _, _, to), R = 1", 1),
    "endsWith": (2, lambda a, _: _sub(Variable("_#2"), 0, a), "sub_atom(today, _, _, 0, day), R = 1", 1),
}


def built_in(name: str, args: Sequence[Term], scope: Scope) -> Body:
    """The conditions that a built-in stands for.

    Raises:
        Beyond: the language has nothing like it, or the arguments do not fit.
    """
    if name in _COMPARED:
        _check_arguments(name, args, 2)
        if name in ORDERING and any(not isinstance(arg, (Variable, int, float)) for arg in args):
            raise Beyond(f"swrlb:{name} compares what is no number; the language compares numbers")
        return (literal(_COMPARED[name], *args),)
    if name in _COMPUTED:
        number, make, trial, result = _COMPUTED[name]
        _check_arguments(name, args[1:], number)
        if not speaks(trial, result):
            raise Beyond(f"swrlb:{name} is not supported, because the language does not compute {trial[5:]}")
        return (literal("is", args[0], make(args[1:])),)
    if name in _SPELT:
        count, spell, trial, answer = _SPELT[name]
        _check_arguments(name, args, count)
        if not speaks(trial, answer):
            raise Beyond(f"swrlb:{name} is not supported, because the language has no {trial.partition('(')[0]}")
        return spell(args, scope)
    raise Beyond(f"swrlb:{name} is not supported, because the language has nothing like it; state its results as facts")


def _check_arguments(name: str, args: Sequence[Term], number: int | None) -> None:
    if (number is None and len(args) < 2) or (number is not None and len(args) != number):
        raise Beyond(f"swrlb:{name} has the wrong number of arguments; mend the rule")
