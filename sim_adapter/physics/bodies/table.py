"""The bodies there are, by name."""

from __future__ import annotations

from casper.kb.errors import DomainError
from casper.sim_adapter.physics.bodies.body import Body
from casper.sim_adapter.physics.bodies.primitive import PRIMITIVE
from casper.sim_adapter.physics.bodies.tiago import TIAGO

BODIES = {body.name: body for body in (PRIMITIVE, TIAGO)}


def body_of(name: str) -> Body:
    """The body of that name.

    Raises:
        DomainError: there is none.
        CasperError: what it is made of is missing; the sentence says what to install.
    """
    if name not in BODIES:
        raise DomainError(f"the robot has no body {name!s:.40}; there are {', '.join(BODIES)}")
    BODIES[name].check()
    return BODIES[name]
