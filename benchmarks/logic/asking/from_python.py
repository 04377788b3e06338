"""SWI-Prolog as a Python user calls it, beside `query`: the same text, the same goals, answers as dictionaries."""

from collections.abc import Iterator

from ..bounds import Bound
from ..figures import Amounts, Found, Sizes
from ..peers import called
from ..peers.engines import Program, loaded
from .kitchen import kitchen
from .rows import tables

TITLE = "SWI-Prolog called from Python"
TIMED = (
    "From a goal as text to a list of answers in Python, warm: casper's `query`, and SWI-Prolog through janus-swi and "
    "pyswip (inside the process) and swiplserver (over a socket), as they come."
)
KITCHEN = {
    "kitchen: a ground yes": "eat(human, biscuits, plate)",
    "kitchen: a ground no": "eat(tiago, meal, plate)",
    "kitchen: eat(A, T, D)": "eat(A, T, D)",
}


def goals(sizes: Sizes) -> tuple[Program, dict[str, str]]:
    """Two relations, and questions about them."""
    size = sizes.python_rows
    rows = tables(size)
    x = rows["r"][0][0]
    return Program(rows, (), ()), {
        f"r(b, Y) of {size:,} rows": f"r({x}, Y)",
        f"r(X, Y), {size:,} rows": "r(X, Y)",
        f"r(X, Y), s(Y, Z) at {size:,} rows": "r(X, Y), s(Y, Z)",
    }


def measure(sizes: Sizes) -> Found:
    """The kitchen, and rows."""
    small = kitchen()
    yield from called.ours(lambda goal: small.query(goal), KITCHEN, sizes)
    yield from called.calls(small.to_text(), KITCHEN, sizes)
    program, asked = goals(sizes)
    kb = loaded(program)
    kb.compile()
    yield from called.ours(lambda goal: kb.query(goal, budget=10**9), asked, sizes)
    yield from called.calls(program.text(), asked, sizes)


def promises(amounts: Amounts, sizes: Sizes) -> Iterator[Bound]:
    """None: these figures are there to be known."""
    yield from ()
