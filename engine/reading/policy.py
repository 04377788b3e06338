"""Decision policies: when a reading commits to a goal.

The table `POLICIES` is the registry; a policy is a function of a `Standing`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from casper.engine.recognition.standing import Standing
from casper.kb.errors import CasperError

Policy: TypeAlias = Callable[[Standing], str | None]


def strict(standing: Standing) -> str | None:
    """Exactly one explanation is left, or the best is strictly best and misses no leaf (the paper's table)."""
    if standing.explanations == 1:
        return standing.best_goal
    return best(standing) if standing.best_missed == 0 else None


def best(standing: Standing) -> str | None:
    """No other goal's explanation scores as high as the best one."""
    return standing.best_goal if standing.rivals == 0 else None


POLICIES: dict[str, Policy] = {"strict": strict, "best": best}


def policy_named(name: str) -> Policy:
    """The policy of that name.

    Raises:
        CasperError: there is none; the sentence lists those there are.
    """
    if name not in POLICIES:
        raise CasperError(f"there is no policy {name!r}; choose {' or '.join(POLICIES)}")
    return POLICIES[name]
