"""How thoroughly: profiles of hypothesis by name, and the settings of the laws.

    CASPER_PROFILE=thorough pytest --casper-domain home
"""

from __future__ import annotations

import os
from collections.abc import Callable
from typing import Any, TypeVar

from hypothesis import HealthCheck, settings

PROFILES = {"quick": 20, "standard": 100, "thorough": 1500}  # examples of each law
VARIABLE = "CASPER_PROFILE"
T = TypeVar("T", bound=Callable[..., Any])

for _name, _examples in PROFILES.items():
    settings.register_profile(f"casper-{_name}", max_examples=_examples, deadline=None)


def load_profile(name: str | None = None) -> None:
    """Choose a profile for all tests: the named one, else the one that the environment names, else none.

    Raises:
        CasperError: there is none of that name.
    """
    from casper.kb.errors import CasperError

    chosen = name or os.environ.get(VARIABLE)
    if not chosen:
        return
    if chosen not in PROFILES:
        raise CasperError(f"there is no profile {chosen!r}; choose {', '.join(PROFILES)}")
    settings.load_profile(f"casper-{chosen}")


def checked(test: T) -> T:
    """A law's settings: as many examples as the profile says, no deadline; a slow domain is no failure."""
    slow = [HealthCheck.too_slow, HealthCheck.filter_too_much, HealthCheck.large_base_example]
    decorated: T = settings(deadline=None, suppress_health_check=slow, print_blob=False)(test)
    return decorated
