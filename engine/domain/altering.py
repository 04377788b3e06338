"""A domain with other settings: what stands in ``setting/3`` replaced, for studies of one knob or several."""

from __future__ import annotations

import pickle
from collections.abc import Mapping
from typing import TYPE_CHECKING

from casper.kb.errors import DomainError
from casper.kb.terms.terms import Compound

if TYPE_CHECKING:
    from casper.engine.domain.domain import Domain


def altered(domain: Domain, settings: Mapping[str, float | int | str | bool]) -> Domain:
    """A copy of the domain in which settings have other values; the domain itself stays as it is.

    Args:
        domain: whose copy.
        settings: values by ``"stage.name"``, as in ``{"sensor.noise": 0.06, "human.walk_speed": 0.9}``.

    Raises:
        DomainError: a name that is not made of a stage and a setting. What no stage knows is refused by that stage.
    """
    if not settings:
        return domain
    copy: Domain = pickle.loads(pickle.dumps(domain))  # pickled here, from what is here
    for key, value in settings.items():
        stage, dot, name = key.partition(".")
        if not (stage and dot and name):
            raise DomainError(f"a setting is named by its stage and its name, as in sensor.noise, not {key!r}")
        stated = ("true" if value else "false") if isinstance(value, bool) else value
        for row in [row for row in copy.kb.rows("setting", 3) if row[:2] == (stage, name)]:
            copy.kb.retract(Compound(("setting", *row)))
        copy.kb.assert_(Compound(("setting", stage, name, stated)))
    return copy
