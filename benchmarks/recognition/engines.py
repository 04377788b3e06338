"""A teller for a kernel: what the figures take."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any, TypeAlias

from casper.engine.recognition.arrays.arrays import Arrays
from casper.engine.recognition.arrays.noisy_arrays import NoisyArrays
from casper.engine.recognition.arrays.pairs import Pairs
from casper.engine.recognition.kernels.chains import Chains
from casper.engine.recognition.kernels.counting import Interleaving
from casper.engine.recognition.teller import Teller
from casper.engine.verification.matching import Matcher
from casper.plans.trees.plan import Plan

Make: TypeAlias = Callable[[Sequence[Plan], Matcher], Teller]

__all__ = ["Arrays", "Chains", "Interleaving", "NoisyArrays", "Pairs", "engine", "name_of"]


def engine(kernel: Callable[..., Any], *more: Any, **options: Any) -> Make:
    """What makes a teller of such a kernel, of plans and a matcher."""
    return lambda plans, matcher: Teller(kernel(plans, matcher, *more, **options), matcher)


def name_of(teller: Teller) -> str:
    """The kernel's name."""
    return type(teller.kernel).__name__
