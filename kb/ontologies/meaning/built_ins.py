"""SWRL's built-ins as conditions: comparisons, arithmetic, and strings."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import reduce

from casper.kb.ontologies.meaning.data_ranges import Body
from casper.kb.ontologies.vocabulary.refusals import Beyond
from casper.kb.ontologies.vocabulary.scope import Scope, literal
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
# How many arguments (None: two or more), and what is made of them.
_COMPUTED: dict[str, tuple[int | None, _Computed]] = {}
_Spelt = Callable[[Sequence[Term], Scope], Body]


def _chained(operator: str) -> _Computed:
    return lambda args: reduce(lambda left, right: Compound((operator, left, right)), args)


def _applied(functor: str) -> _Computed:
    return lambda args: Compound((functor, *args))


_COMPUTED.update(
    {
        "add": (None, _chained("+")),
        "subtract": (2, _chained("-")),
        "multiply": (None, _chained("*")),
        "divide": (2, _chained("/")),
        "unaryPlus": (1, lambda args: Compound(("+", args[0], 0))),
        "unaryMinus": (1, lambda args: Compound(("-", 0, args[0]))),
        "integerDivide": (2, _chained("//")),
        "mod": (2, _chained("rem")),
        "pow": (2, _chained("**")),
        "round": (1, lambda args: Compound(("floor", Compound(("+", args[0], 0.5))))),
        **{name: (1, _applied(name)) for name in ("abs", "ceiling", "floor", "sin", "cos", "tan")},
    }
)


def _concatenated(args: Sequence[Term], scope: Scope) -> Body:
    whole, first, *others = args
    rest = others or [""]  # one text alone is the whole
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


_SPELT: dict[str, tuple[int | None, _Spelt]] = {
    "stringConcat": (None, _concatenated),
    "stringLength": (2, lambda a, _: (literal("atom_length", a[1], a[0]),)),
    "upperCase": (2, lambda a, _: (literal("upcase_atom", a[1], a[0]),)),
    "lowerCase": (2, lambda a, _: (literal("downcase_atom", a[1], a[0]),)),
    "stringEqualIgnoreCase": (2, _alike),
    "contains": (2, lambda a, _: _sub(Variable("_#2"), Variable("_#3"), a)),
    "startsWith": (2, lambda a, _: _sub(0, Variable("_#3"), a)),
    "endsWith": (2, lambda a, _: _sub(Variable("_#2"), 0, a)),
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
        number, make = _COMPUTED[name]
        _check_arguments(name, args[1:], number)
        return (literal("is", args[0], make(args[1:])),)
    if name in _SPELT:
        count, spell = _SPELT[name]
        _check_arguments(name, args, count)
        return spell(args, scope)
    raise Beyond(f"swrlb:{name} is not supported, because the language has nothing like it; state its results as facts")


def _check_arguments(name: str, args: Sequence[Term], number: int | None) -> None:
    if (number is None and len(args) < 2) or (number is not None and len(args) != number):
        raise Beyond(f"swrlb:{name} has the wrong number of arguments; mend the rule")
