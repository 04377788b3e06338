"""The site builds without a warning, every link leads somewhere, and nothing is fetched from elsewhere.

The thorough profile builds all of it; otherwise the API and the notebooks, which take most of the time, are left out,
and that what they show is there is looked up.
"""

import os
import re
import subprocess
import sys

import pytest
from pages import DOCS, PAGES, ROOT, links_of, name_of

THOROUGH = os.environ.get("HYPOTHESIS_PROFILE") == "thorough"
HOUSES = ("kb", "plans", "engine", "sim_adapter", "domains", "src", "tests", "benchmarks", "docs", "examples")


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    pytest.importorskip("mkdocs_jupyter")
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    told = {"NO_MKDOCS_2_WARNING": "1", "PYTHONPATH": str(ROOT / "src"), "CASPER_WHOLE_SITE": str(THOROUGH).lower()}
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, env={**os.environ, **told})
    assert (done.returncode, done.stderr) == (0, "")
    return folder


@pytest.mark.xdist_group("site")
def test_pages_fetch_nothing_from_elsewhere(site):
    assert (site / "tutorial" / "index.html").exists()
    for page in site.rglob("*.html"):
        loaded = re.findall(r'<(?:script|link|img)[^>]+(?:src|href)="(https?://[^"]+)"', page.read_text())
        assert not loaded, page


@pytest.mark.xdist_group("site")
@pytest.mark.skipif(not THOROUGH, reason="reads every docstring: HYPOTHESIS_PROFILE=thorough")
def test_the_api_shows_what_the_docstrings_say(site):
    page = (site / "api" / "knowledge_base" / "index.html").read_text()
    assert "Why the statement is not provable or not valid" in page


def test_every_page_and_notebook_is_in_the_navigation():
    navigation = (ROOT / "mkdocs.yml").read_text()
    for page in [*DOCS.rglob("*.md"), *DOCS.rglob("*.ipynb")]:
        assert f": {page.relative_to(DOCS)}\n" in navigation


@pytest.mark.parametrize("page", sorted((DOCS / "api").glob("*.md")), ids=lambda page: page.stem)
def test_what_the_api_pages_name_is_there(page):
    for name in re.findall(r"^::: (casper\S+)$", page.read_text(), re.M):
        module, _, last = name.rpartition(".")
        file = ROOT / "src" / f"{name.replace('.', '/')}.py"
        if not file.exists():
            assert f"\nclass {last}" in (ROOT / "src" / f"{module.replace('.', '/')}.py").read_text(), name


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_a_link_to_a_file_leads_to_one(page):
    for target in links_of(page):
        if not re.match(r"[a-z]+:|#", target):
            assert (page.parent / target.partition("#")[0]).exists(), target


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_a_file_that_a_page_names_is_there(page):
    named = re.findall(rf"`((?:{'|'.join(HOUSES)})/[\w./-]+)`", page.read_text())
    assert [name for name in named if not (ROOT / name).exists()] == []
