"""What goes wrong in a method, as an error of the protocol: the sentence, and where the mistake stands."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from casper.kb.errors import BudgetExceeded, CasperError, ReadError, Undefined
from casper.server.protocol import ProtocolError


def told(work: Callable[[], Any]) -> Any:
    """What the work gives.

    Raises:
        ProtocolError: for whatever it raises, a fault of ours too: that is no reason to lose the conversation.
    """
    try:
        return work()
    except ProtocolError:
        raise
    except CasperError as mistake:
        raise ProtocolError(_kind(mistake), str(mistake), **_data(mistake)) from None
    except RecursionError:
        raise ProtocolError("unknown", "this goes too deep to be answered") from None
    except MemoryError:
        raise ProtocolError("unknown", "there is not enough memory to answer this") from None
    except Exception as mistake:
        sentence = f"casper itself failed at this: {type(mistake).__name__}: {mistake}"
        raise ProtocolError("internal", sentence) from mistake


def _kind(mistake: CasperError) -> str:
    kinds = {Undefined: "undefined", BudgetExceeded: "unknown"}
    return kinds.get(type(mistake), "mistake")


def _data(mistake: CasperError) -> dict[str, Any]:
    data: dict[str, Any] = {"type": type(mistake).__name__}
    if mistake.place is not None:
        data |= {"file": mistake.place.file, "line": mistake.place.line, "column": mistake.place.column}
    if isinstance(mistake, ReadError) and mistake.excerpt:
        data["excerpt"] = mistake.excerpt
    return data
