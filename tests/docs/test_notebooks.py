"""The notebooks run from the first cell to the last, and show what they show."""

import re

import pytest
from notebooks import NOTEBOOKS, executed, texts
from pages import ROOT

nbformat = pytest.importorskip("nbformat")
pytest.importorskip("nbclient")


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_shows_what_happens(file, tmp_path):
    if file.stem == "planner":
        pytest.importorskip("unified_planning")
    notebook = nbformat.read(file, 4)
    assert texts(executed(notebook, tmp_path)) == texts(notebook)


@pytest.mark.parametrize("file", NOTEBOOKS, ids=lambda file: file.stem)
def test_a_notebook_holds_nothing_of_the_machine_that_ran_it(file):
    text = file.read_text()
    assert not re.search(r"/(?:home|root|tmp|work|Users)/", text) and str(ROOT) not in text
    assert "Traceback" not in text
