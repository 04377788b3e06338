"""Hypothesis profiles: the default looks at the same examples in every run, the others at new ones or at many more.

A gate must give the same answer twice, so that a commit is refused for what it changed and for nothing else. What
chance finds is looked for on purpose: ``HYPOTHESIS_PROFILE=fresh`` draws new examples, ``thorough`` thirty times as
many.
"""

import os

from hypothesis import HealthCheck, Phase, settings

settings.register_profile("fresh", deadline=None, max_examples=50, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("default", parent=settings.get_profile("fresh"), derandomize=True, database=None)
settings.register_profile("thorough", parent=settings.get_profile("fresh"), max_examples=1500)
settings.register_profile(  # for mutants: whether a test fails, not the smallest example with which it does
    "derandomised", parent=settings.get_profile("default"), phases=[Phase.explicit, Phase.generate]
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "default"))
