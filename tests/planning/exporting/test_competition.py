"""Hierarchical domains of the planning competition come in without being enumerated, and come back unchanged.

The framework ships 28 of them, with a problem each; three more are made in the manner of others (``competition/``). The
gate takes those that are small, the thorough profile all.
"""

from pathlib import Path

import pytest
from hypothesis import settings

pytest.importorskip("unified_planning", reason="planning needs: pip install 'casper-hri[planning]'")

import unified_planning

from casper.planning import import_files, import_problem, to_problem

SHIPPED = Path(unified_planning.__file__).parent / "test" / "hddl"
OURS = Path(__file__).resolve().parents[1] / "competition"
SMALL = {"2020-po-Satellite", "2020-to-Towers", "barman", "freecell", "um-translog"}
EVERY = sorted(folder for place in (SHIPPED, OURS) if place.is_dir() for folder in place.iterdir() if folder.is_dir())
CHOSEN = [folder for folder in EVERY if folder.name in SMALL or settings.default.max_examples > 50]


@pytest.mark.parametrize("folder", CHOSEN, ids=lambda folder: folder.name)
def test_a_domain_of_the_competition_comes_back_unchanged(folder: Path) -> None:
    imported = import_files(sorted(folder.glob("*.hddl")))
    assert [str(finding) for finding in imported.findings] == []
    domain = imported.domain()
    assert import_problem(to_problem(domain)).files == imported.files
    assert domain.kb.stored(("method", 1)) is None  # nothing is listed for the ways to fill parameters
