"""Every code block and every command of the documentation is run, and prints what the page shows."""

import pytest
from pages import PAGES, blocks_of, name_of
from visits import Visit


@pytest.mark.parametrize("page", PAGES, ids=name_of)
def test_a_page_shows_what_happens(page, tmp_path):
    visit = Visit(tmp_path)
    for block in blocks_of(page):
        if not block.why:
            visit.run(block)
