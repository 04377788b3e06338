"""What the page of limits says of other pages is what they say."""

import re

from pages import DOCS

LIMITS = (DOCS / "limits.md").read_text()


def test_promises_that_are_not_kept_are_counted_as_the_benchmarks_do():
    told = re.search(r"Of (\d+) promises \d+ are kept, (\d+) are not", (DOCS / "benchmarks.md").read_text())
    assert "of {} promises to itself {} are not kept".format(*told.groups()) in " ".join(LIMITS.split())


def test_every_share_of_a_benchmark_of_days_stands_where_it_was_measured():
    measured = (DOCS / "recognition.md").read_text()
    for share in re.findall(r"\b\d+ of (?:120|200)\b", LIMITS):
        assert share in measured
