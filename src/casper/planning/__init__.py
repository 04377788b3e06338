"""Planners: Unified Planning's problems and plans in and out (docs/planning.md; needs ``casper-hri[planning]``).

In: the framework's problems and plans, PDDL and HDDL. Out: verdicts with reasons, domains, what is left of a plan,
behaviour trees (these need ``casper-hri[behaviour-trees]`` only). Each name is loaded when it is used. Importing this
registers the engine ``casper`` with the framework: ``PlanValidator(name="casper")``.
"""

from __future__ import annotations

from importlib import import_module
from importlib.util import find_spec
from typing import TYPE_CHECKING, Any

from casper.kb.errors import CasperError

if TYPE_CHECKING:
    from casper.planning.behaviours.tree import behaviour_tree
    from casper.planning.exporting.exporting import to_problem
    from casper.planning.importing.files import import_files
    from casper.planning.importing.importing import LeftOut, from_problem, import_problem
    from casper.planning.importing.vocabulary import Who
    from casper.planning.remaining.remainder import Remainder, remainder

ENGINE = "casper"
INSTALL = "pip install 'casper-hri[planning]'"
_WITHOUT = frozenset({"behaviour_tree"})  # what needs no Unified Planning
_WHERE = {
    "LeftOut": "importing.importing",
    "Remainder": "remaining.remainder",
    "Who": "importing.vocabulary",
    "behaviour_tree": "behaviours.tree",
    "from_problem": "importing.importing",
    "import_files": "importing.files",
    "import_problem": "importing.importing",
    "remainder": "remaining.remainder",
    "to_problem": "exporting.exporting",
}
__all__ = [
    "LeftOut",
    "Remainder",
    "Who",
    "behaviour_tree",
    "from_problem",
    "import_files",
    "import_problem",
    "register",
    "remainder",
    "to_problem",
]


def __getattr__(name: str) -> Any:
    if name not in _WHERE:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if not _is_there() and name not in _WITHOUT:
        raise CasperError(f"casper.planning.{name} needs Unified Planning: {INSTALL}")
    return getattr(import_module(f"{__name__}.{_WHERE[name]}"), name)


def _is_there() -> bool:
    return find_spec("unified_planning") is not None


def register() -> None:
    """Make ``PlanValidator(name="casper")`` work in the framework's global environment; done by importing this.

    Raises:
        CasperError: the framework is not installed.
    """
    if not _is_there():
        raise CasperError(f"planning needs Unified Planning: {INSTALL}")
    from unified_planning.environment import get_environment

    factory = get_environment().factory
    if ENGINE not in factory.engines:
        factory.add_engine(ENGINE, "casper.planning.engine", "CasperValidator")


if _is_there():
    register()
