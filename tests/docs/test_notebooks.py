"""The notebooks run from the first cell to the last, and show what they show."""

import os
import re

import pytest
from notebooks import NOTEBOOKS, executed, printed, texts
from pages import ROOT

nbformat = pytest.importorskip("nbformat")
pytest.importorskip("IPython")
THOROUGH = os.environ.get("HYPOTHESIS_PROFILE") == "thorough"


@pytest.fixture(params=NOTEBOOKS, ids=lambda file: file.stem)
def notebook(request):
    if request.param.stem == "planner":
        pytest.importorskip("unified_planning")
    return nbformat.read(request.param, 4)


def test_a_notebook_shows_what_happens(notebook, tmp_path):
    assert printed(notebook, tmp_path) == texts(notebook)


@pytest.mark.skipif(not THOROUGH, reason="starts a kernel: HYPOTHESIS_PROFILE=thorough")
def test_a_kernel_shows_the_same(notebook, tmp_path):
    pytest.importorskip("nbclient")
    assert texts(executed(notebook, tmp_path)) == texts(notebook)


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_holds_nothing_of_the_machine_that_ran_it(file):
    text = file.read_text()
    assert not re.search(r"/(?:home|root|tmp|work|Users)/", text) and str(ROOT) not in text
    assert "Traceback" not in text
