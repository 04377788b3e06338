"""Notebooks are executed, and what is compared is what they print: outputs as text.

A kernel of its own executes one as a reader's does (`executed`); the same cells in this process say the same, in a
fraction of the time (`printed`).
"""

from __future__ import annotations

import contextlib
import copy
import io
import os

from pages import DOCS, ROOT

NOTEBOOKS = sorted((DOCS / "notebooks").glob("*.ipynb"))


def executed(notebook, folder):
    """A copy of the notebook with the outputs of today, by a kernel.

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


def printed(notebook, folder):
    """By cell what it prints and shows, in this process.

    Raises:
        Exception: a cell fails.
    """
    from IPython.core.interactiveshell import InteractiveShell
    from traitlets.config import Config

    shell = InteractiveShell.instance(config=Config(HistoryManager={"enabled": False}), ipython_dir=str(folder))
    try:
        with contextlib.chdir(folder):
            return [_said(shell, cell.source) if cell.cell_type == "code" else "" for cell in notebook.cells]
    finally:
        InteractiveShell.clear_instance()


def _said(shell, source):
    shown = []
    shell.displayhook.write_output_prompt = lambda: None
    shell.displayhook.write_format_data = lambda data, metadata=None: shown.append(data["text/plain"])
    with contextlib.redirect_stdout(io.StringIO()) as out:
        shell.run_cell(source, store_history=True).raise_error()
    return (out.getvalue() + "".join(shown)).strip()


def texts(notebook):
    """By cell what the notebook says that it prints and shows."""
    return ["".join(map(_text, cell.get("outputs", ()))).strip() for cell in notebook.cells]


def _text(output):
    if output["output_type"] == "stream":
        return output["text"]
    if output["output_type"] == "error":
        return output["evalue"]
    return output["data"]["text/plain"]
