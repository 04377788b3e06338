"""The framework's example problems, without its credits."""

import warnings

import pytest

unified_planning = pytest.importorskip("unified_planning", reason="planning needs: pip install 'casper-hri[planning]'")


@pytest.fixture(scope="session", autouse=True)
def _quiet() -> None:
    unified_planning.environment.get_environment().credits_stream = None
    warnings.filterwarnings("ignore", module="unified_planning")


@pytest.fixture(scope="session")
def examples() -> dict:
    from unified_planning.test.examples import get_example_problems

    return get_example_problems()
