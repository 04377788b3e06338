"""CASPER in logic: read a partner's intention, say why, and help.

``import casper`` is light: what needs networkx, scikit-learn or MuJoCo is loaded when first used.
"""

from __future__ import annotations

__version__ = "0.1.0"
