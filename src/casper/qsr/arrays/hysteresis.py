"""Labels that are harder to leave than to keep, along the steps of a whole trace."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from casper.qsr.arrays.scene import Array


def kept(plain: Array, may_keep: Array, before: Array) -> Array:
    """Codes with memory: a step keeps the code of the step before where it may, and else has its plain one.

    plain: things by steps, -1 where there is none, which is never kept. may_keep: codes by things by steps. before: the
    code of each thing at the step before the first, -1 for none.

    Most steps say the same whatever was before; the others are settled in rounds, each step after the one before it.
    """
    codes = plain.copy()
    kinds = may_keep.shape[0]
    choices = may_keep.sum(axis=0, dtype=np.int16)
    index = np.clip(plain, 0, kinds - 1)
    own = np.take_along_axis(may_keep, index[None].astype(np.intp), axis=0)[0]
    open_ = (plain >= 0) & ((choices - own) > 0)
    things, steps = np.nonzero(open_)
    depth = _depths(open_)[things, steps]
    order = np.argsort(depth, kind="stable")
    things, steps = things[order], steps[order]
    rounds = np.cumsum(np.bincount(depth)) if depth.size else np.zeros(1, dtype=np.intp)
    for start, stop in pairwise(rounds.tolist()):
        i, t = things[start:stop], steps[start:stop]
        earlier = np.where(t > 0, codes[i, t - 1], before[i])
        keeps = (earlier >= 0) & may_keep[np.clip(earlier, 0, kinds - 1), i, t]
        codes[i, t] = np.where(keeps, earlier, plain[i, t])
    return codes


def _depths(open_: Array) -> Array:
    """How many steps in a row are open, up to each."""
    steps = np.arange(1, open_.shape[1] + 1)
    closed = np.maximum.accumulate(np.where(open_, 0, steps), axis=1)
    return np.where(open_, steps - closed, 0)
