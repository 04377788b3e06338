"""Numbers of a text or of somebody else's data, as floats."""

from __future__ import annotations

import math
from typing import Any


def as_float(value: Any) -> float:
    """The number as a float; NaN where it is none, a truth value, or an integer too large for a float.

    So whoever compares it refuses all of these alike: no comparison holds of NaN.
    """
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return math.nan
    try:
        return float(value)
    except OverflowError:
        return math.nan
