"""A method's parameters: what its function's annotations say of them, as JSON Schema and as a check."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from functools import cache
from inspect import Parameter, signature
from types import NoneType, UnionType
from typing import Any, get_args, get_origin, get_type_hints

from casper.server.protocol import Params, ProtocolError

_SCHEMAS: dict[type, dict[str, Any]] = {
    str: {"type": "string"},
    bool: {"type": "boolean"},
    int: {"type": "integer"},
    float: {"type": "number"},
    NoneType: {"type": "null"},
}
_WORDS = {str: "a string", bool: "true or false", int: "a whole number", float: "a number", NoneType: "null"}


@cache
def parameters(run: Callable[..., Any]) -> tuple[tuple[str, tuple[Any, ...], bool], ...]:
    """Name, the types that it may have, and whether it may be left out, of every parameter but the conversation."""
    hints = get_type_hints(run)
    some = list(signature(run).parameters.values())[1:]
    return tuple((p.name, _kinds(hints[p.name]), p.default is not Parameter.empty) for p in some)


def schema_of(kinds: Sequence[Any]) -> dict[str, Any]:
    """The JSON Schema of a parameter that may have one of these types."""
    schemas = [
        {"type": "object", "additionalProperties": {"type": "number"}} if get_origin(kind) is dict else _SCHEMAS[kind]
        for kind in kinds
    ]
    return schemas[0] if len(schemas) == 1 else {"anyOf": schemas}


def arguments(run: Callable[..., Any], params: Params) -> dict[str, Any]:
    """The arguments of a call, by name.

    Raises:
        ProtocolError: one is missing, unknown, of a wrong type, or there are too many.
    """
    known = parameters(run)
    given = _named(params, [name for name, _, _ in known])
    for name, kinds, may_lack in known:
        if name not in given:
            if not may_lack:
                raise ProtocolError("params", f"the parameter {name} is missing; it is {_told(kinds)}")
        elif not any(_fits(given[name], kind) for kind in kinds):
            raise ProtocolError("params", f"the parameter {name} is {_told(kinds)}")
    return given


def _named(params: Params, names: Sequence[str]) -> dict[str, Any]:
    takes = f"it takes {', '.join(names)}" if names else "it takes none"
    if not isinstance(params, Mapping):
        if len(params) > len(names):
            raise ProtocolError("params", f"there are {len(params)} parameters; {takes}")
        return dict(zip(names, params))
    for name in params:
        if name not in names:
            raise ProtocolError("params", f"there is no parameter {name!r}; {takes}")
    return dict(params)


def _kinds(hint: Any) -> tuple[Any, ...]:
    return get_args(hint) if isinstance(hint, UnionType) else (hint,)


def _fits(value: Any, kind: Any) -> bool:
    if get_origin(kind) is dict:
        return isinstance(value, dict) and all(_fits(number, float) for number in value.values())
    if isinstance(value, bool):
        return kind is bool
    return isinstance(value, (int, float) if kind is float else kind)


def _told(kinds: Sequence[Any]) -> str:
    return " or ".join(
        "an object of numbers" if get_origin(kind) is dict else _WORDS[kind] for kind in kinds
    )
