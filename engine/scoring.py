"""The score of an explanation (paper equation "score"), over terminal nodes.

    s = (observed / leaves) * (1 - missed / leaves)

With last marked leaf j (from 0) of n and k observations, missed = j + 1 - k, so s = k (n - j - 1 + k) / n^2. Computed
from integers by one division it is correctly rounded: equal scores are equal floats, so ties are exact.
"""

from __future__ import annotations


def numerator(leaves: int, observed: int, last: int) -> int:
    """k (n - j - 1 + k): the score times n^2."""
    return observed * (leaves - last - 1 + observed)


def score(leaves: int, observed: int, last: int) -> float:
    """The score of an explanation with ``observed`` marked leaves, the last of them leaf number ``last``."""
    return numerator(leaves, observed, last) / (leaves * leaves)
