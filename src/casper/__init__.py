"""CASPER in logic: read a partner's intention, say why, and help.

``import casper`` is light: each name below is loaded when it is first used, networkx, scikit-learn and MuJoCo only
by what needs them.

    from casper import Domain
    kitchen = Domain.load("kitchen")
    kitchen.kb.ask("wash(tiago, plate, sink)")            # True
    print(kitchen.kb.why_not("eat(tiago, meal, plate)"))  # tiago is not a human
    reading = kitchen.reading()
    reading.observe("pick_and_place(meal, hobs)")
    reading.posterior, reading.best(3), reading.frontier, reading.plan_for("tiago")
    print(reading)                                        # what casper explain shows
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any

from casper.kb.text.lines import Form, show_with

if TYPE_CHECKING:
    from casper.engine.domain.domain import Domain as Domain
    from casper.engine.mind import Mind as Mind
    from casper.engine.perception.world import WorldState as WorldState
    from casper.engine.reading.reading import Reading as Reading
    from casper.kb.base import KnowledgeBase as KnowledgeBase
    from casper.kb.errors import CasperError as CasperError
    from casper.plans.library import PlanLibrary as PlanLibrary

__version__ = "0.1.0"

_HOMES = {
    "CasperError": "casper.kb.errors",
    "Domain": "casper.engine.domain.domain",
    "KnowledgeBase": "casper.kb.base",
    "Mind": "casper.engine.mind",
    "PlanLibrary": "casper.plans.library",
    "Reading": "casper.engine.reading.reading",
    "WorldState": "casper.engine.perception.world",
    "load_ipython_extension": "casper.notebook.magics",  # %load_ext casper
    "unload_ipython_extension": "casper.notebook.magics",
}
__all__ = ["CasperError", "Domain", "KnowledgeBase", "Mind", "PlanLibrary", "Reading", "WorldState", "__version__"]


def _shows(thing: object, form: Form) -> str | None:
    """How a notebook shows what one holds: nothing of it is imported before a notebook asks."""
    shown: str | None = import_module("casper.notebook.table").shown(thing, form)
    return shown


show_with(_shows)


def __getattr__(name: str) -> Any:
    if name in _HOMES:
        return getattr(import_module(_HOMES[name]), name)
    raise AttributeError(f"module 'casper' has no attribute {name!r}")


def __dir__() -> list[str]:
    return sorted(__all__)
