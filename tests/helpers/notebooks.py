"""Notebooks are executed by a kernel of their own, and what is compared is what they print: outputs as text."""

from __future__ import annotations

import copy
import os

from pages import DOCS, ROOT

NOTEBOOKS = sorted((DOCS / "notebooks").glob("*.ipynb"))


def executed(notebook, folder):
    """A copy of the notebook with the outputs of today.

    Raises:
        CellExecutionError: a cell fails.
    """
    from nbclient import NotebookClient

    fresh = copy.deepcopy(notebook)
    paths = [str(ROOT / "src"), *filter(None, [os.environ.get("PYTHONPATH")])]
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join(paths), "PYDEVD_DISABLE_FILE_VALIDATION": "1"}
    resources = {"metadata": {"path": str(folder)}}
    NotebookClient(fresh, timeout=120, kernel_name="python3", resources=resources).execute(env=environment)
    for cell in fresh.cells:
        cell.metadata.pop("execution", None)  # when it ran is nobody's business
    return fresh


def texts(notebook):
    """By cell what it prints or shows, as text."""
    return [[_text(output) for output in cell.get("outputs", ())] for cell in notebook.cells]


def _text(output):
    if output["output_type"] == "stream":
        return output["text"]
    if output["output_type"] == "error":
        return output["evalue"]
    return output["data"]["text/plain"]
