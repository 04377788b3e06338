"""``%load_ext casper``: cells of clauses (``%%casper``), questions (``%ask``), reasons (``%why``).

A mistake is the sentence that the command line would show, without a traceback; what stands after it in the notebook
does not run.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import wraps
from typing import Any

from IPython.core.error import UsageError
from IPython.core.interactiveshell import InteractiveShell
from IPython.core.magic import Magics, line_cell_magic, line_magic, magics_class, no_var_expand

from casper.engine.domain.domain import Domain
from casper.kb.errors import CasperError
from casper.kb.reasons.doubt import Doubt
from casper.kb.reasons.proof import Proof
from casper.kb.reasons.why_not import Refusal
from casper.notebook.asked import Asked, asked
from casper.notebook.cells import Cells

VARIABLE = "domain"  # what the domain of the cells is called in Python
NAMES = {"line": ("casper", "ask", "why"), "cell": ("casper",)}


def _in_a_sentence(magic: Callable[..., Any]) -> Callable[..., Any]:
    """A mistake of the user as IPython's own error for that: one sentence, no traceback."""

    @wraps(magic)
    def said(*arguments: str) -> Any:
        try:
            return magic(*arguments)
        except CasperError as mistake:
            raise UsageError(str(mistake)) from None

    return said


def _as_written(magic: Callable[..., Any]) -> Callable[..., Any]:
    """Braces and dollar signs of the language are not Python's to fill in."""
    kept: Callable[..., Any] = no_var_expand(magic)
    return kept


@magics_class
class CasperMagics(Magics):
    """The magics; ``cells`` is what they have said so far."""

    shell: InteractiveShell

    def __init__(self, shell: InteractiveShell) -> None:
        super().__init__(shell)
        self.cells = Cells()

    @line_cell_magic
    @_as_written
    @_in_a_sentence
    def casper(self, line: str, cell: str | None = None) -> Domain:
        """``%%casper [NAME]``: facts, rules, constraints, goals and plans; ``domain`` is all that was said so far.

        A cell that is run again replaces what it said. Cells are told apart by their name; without one by the identity
        that the front end gives them, else by their text. ``%casper kitchen`` begins with a shipped domain or a folder;
        ``%casper`` shows the domain as it is.
        """
        name = line.strip()
        if cell is None:
            return self._told(self.cells.begin_with(name) if name else self.cells.domain)
        key, place = name or self._cell_id() or cell, name or f"In [{self.shell.execution_count}]"
        return self._told(self.cells.take(key, cell, place))

    @line_magic
    @_as_written
    @_in_a_sentence
    def ask(self, line: str) -> Asked:
        """``%ask eat(A, T, D), \\+ D = sink``: the answers, the first twenty."""
        return asked(self.cells.domain.kb, line.strip().removesuffix("."))

    @line_magic
    @_as_written
    @_in_a_sentence
    def why(self, line: str) -> Proof | Doubt | Refusal | None:
        """``%why eat(ann, meal, plate)``: its proof, or what stands against it; ``%why not …`` asks the same."""
        statement = line.strip().removeprefix("not ").strip().removesuffix(".")
        kb = self.cells.domain.kb
        refusal = kb.why_not(statement)
        if refusal is not None and not refusal.doubt:
            return refusal
        return kb.why(statement) or refusal

    def _told(self, domain: Domain) -> Domain:
        self.shell.user_ns[VARIABLE] = domain
        return domain

    def _cell_id(self) -> str | None:
        """What the front end calls the cell; not all do."""
        parent = getattr(self.shell, "parent_header", None) or {}
        found = parent.get("metadata", {}).get("cellId") if isinstance(parent, dict) else None
        return str(found) if found else None


def load_ipython_extension(shell: InteractiveShell) -> None:
    """What ``%load_ext casper`` calls."""
    shell.register_magics(CasperMagics(shell))


def unload_ipython_extension(shell: InteractiveShell) -> None:
    """What ``%unload_ext casper`` calls: the magics go, ``domain`` stays."""
    for kind, names in NAMES.items():
        for name in names:
            shell.magics_manager.magics[kind].pop(name, None)
