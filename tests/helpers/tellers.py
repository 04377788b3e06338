"""A teller for each kernel, made of plans, a matcher and what else the kernel takes."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

from casper.engine.recognition.arrays import arrays, noisy_arrays, pairs
from casper.engine.recognition.kernels import chains, counting
from casper.engine.recognition.teller import Teller


def told(kernel: Callable[..., Any]) -> Callable[..., Teller]:
    """What makes a teller of such a kernel."""
    return lambda plans, matcher, *args, **options: Teller(kernel(plans, matcher, *args, **options), matcher)


Chains, Counting, Interleaving = told(chains.Chains), told(counting.Counting), told(counting.Interleaving)
Arrays, NoisyArrays = told(arrays.Arrays), told(noisy_arrays.NoisyArrays)
NoisyPairs = told(pairs.Pairs)


def Pairs(plans, matcher, priors=None):
    """All pairs, with no needless observation."""
    return Teller(pairs.Pairs(plans, matcher, None, priors), matcher)


def observed(tellers, seen):
    """The tellers, after each of them has observed all that was seen."""
    for observation in seen:
        for teller in tellers:
            teller.observe(observation)
    return tellers
