"""The site builds without a warning, every link leads somewhere, and nothing is fetched from elsewhere."""

import os
import re
import subprocess
import sys

import pytest
from pages import PAGES, ROOT, links_of, name_of

pytest.importorskip("mkdocs")


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "--quiet", "--site-dir", str(folder)]
    told = {**os.environ, "NO_MKDOCS_2_WARNING": "1", "PYTHONPATH": str(ROOT / "src")}
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, env=told)
    assert done.returncode == 0, done.stderr
    assert "WARNING" not in done.stderr
    return folder


@pytest.mark.xdist_group("site")
def test_every_page_is_in_the_navigation(site):
    navigation = (ROOT / "mkdocs.yml").read_text()
    for page in PAGES:
        if "docs" in page.parts:
            assert str(page.relative_to(ROOT / "docs")) in navigation


@pytest.mark.xdist_group("site")
def test_pages_fetch_nothing_from_elsewhere(site):
    for page in site.rglob("*.html"):
        loaded = re.findall(r'<(?:script|link|img)[^>]+(?:src|href)="(https?://[^"]+)"', page.read_text())
        assert not loaded, page


@pytest.mark.xdist_group("site")
def test_the_api_shows_what_the_docstrings_say(site):
    page = (site / "api" / "knowledge_base" / "index.html").read_text()
    assert "Why the statement is not provable or not valid" in page


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_a_link_to_a_file_leads_to_one(page):
    for target in links_of(page):
        if not re.match(r"[a-z]+:|#", target):
            assert (page.parent / target.partition("#")[0]).exists(), target
