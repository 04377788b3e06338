"""The server's schema as an OpenRPC document: every method, its parameters and its result as JSON Schema."""

from __future__ import annotations

from typing import Any

from casper import __version__
from casper.server.methods import METHODS, Method
from casper.server.protocol import CODES
from casper.server.signatures import parameters, schema_of

CANCEL = {
    "name": "cancel",
    "summary": "Stop the request of that id, or forget it where it still waits; it is answered with an error. "
    "What changes something is not stopped once it runs.",
    "params": [{"name": "id", "required": True, "schema": {"type": ["string", "number"]}}],
    "result": {"name": "result", "schema": {"type": "boolean"}},
}


def document() -> dict[str, Any]:
    """The whole schema (https://spec.open-rpc.org)."""
    errors = [{"code": code, "message": name} for name, code in CODES.items()]
    return {
        "openrpc": "1.3.2",
        "info": {"title": "casper serve", "version": __version__},
        "methods": [*(_method(name, method) for name, method in METHODS.items()), CANCEL],
        "components": {"x-errors": errors},
    }


def _method(name: str, method: Method) -> dict[str, Any]:
    return {
        "name": name,
        "summary": method.summary,
        "paramStructure": "either",
        "params": [
            {"name": parameter, "required": not may_lack, "schema": schema_of(kinds)}
            for parameter, kinds, may_lack in parameters(method.run)
        ],
        "result": {"name": "result", "schema": dict(method.gives)},
        "x-changes": method.changes,
    }
