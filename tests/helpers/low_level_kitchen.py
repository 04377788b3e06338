"""What the low-level tests share: the kitchen's facts, and shorthand for movements and relations."""

import itertools
from pathlib import Path

from casper.engine.domain.domain import SHIPPED, Domain
from casper.engine.movements.features import HOLD, MOS, QTC
from casper.engine.perception.focus import Focus
from casper.engine.perception.perception import Relations

GOLDEN = Path(__file__).parent.parent / "golden" / "fsm_response.json"
QDC = ("touch", "near", "medium", "far", "ignore")
_NAMES = {"S": "still", "W": "walk", "T": "transport", "P": "pick", "L": "place"}


def kitchen_rows():
    return Domain.load(SHIPPED / "kitchen").kb.rows


def rows_of(facts):
    """Rows from a dict such as {("setting", 3): [("focus", "threshold", 0.5)]}."""
    return lambda name, arity: facts.get((name, arity), [])


def movements(letters):
    """W P T L ... as the names of movements."""
    return [_NAMES[letter] for letter in letters.replace(" ", "")]


def five_clauses():
    """The paper's tree, as rows of movement/5: by what is in the hand, MOS and QTC."""

    def movement(mos, hold, qtc):
        if hold == "holding":
            return "transport" if mos == "moving" else "place"
        if mos == "moving":
            return "walk"
        return "pick" if qtc in ("0", "-") else "still"

    return [(*values, movement(values[0], values[1], values[3])) for values in itertools.product(MOS, HOLD, QDC, QTC)]


def seen(t, qdc, qtc=None, angle=None, moving=False, holding=None):
    """Relations with given labels; QTC 0 and angle 0 unless told."""
    qtc = {name: "0" for name in qdc} | (qtc or {})
    return Relations(t, "human", moving, holding, qdc, qtc, {name: 0.0 for name in qdc} | (angle or {}))


def attending(t, target=None, destination=None):
    return Focus(t, target, destination, {})
