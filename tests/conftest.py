"""Hypothesis profiles: HYPOTHESIS_PROFILE=thorough looks at many more examples, derandomised always at the same."""

import os

from hypothesis import HealthCheck, Phase, settings

settings.register_profile("default", deadline=None, max_examples=50, suppress_health_check=[HealthCheck.too_slow])
settings.register_profile("thorough", parent=settings.get_profile("default"), max_examples=1500)
settings.register_profile(  # for mutants: whether a test fails, not the smallest example with which it does
    "derandomised",
    parent=settings.get_profile("default"),
    derandomize=True,
    database=None,
    phases=[Phase.explicit, Phase.generate],
)
settings.load_profile(os.environ.get("HYPOTHESIS_PROFILE", "default"))
