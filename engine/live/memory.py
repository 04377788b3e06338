"""What was loaded is kept for good: Python's garbage collector need not walk through it again.

A domain is hundreds of thousands of objects, and a collection that walks through them all is the longest pause that a
step of the mind can have. Programs that load first and then go on for ever call this between the two.
"""

from __future__ import annotations

import gc


def keep_loaded() -> None:
    """What there is now is never looked at by the collector again (what nobody holds any more still goes)."""
    gc.freeze()
