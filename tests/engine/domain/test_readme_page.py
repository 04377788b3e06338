"""README.md shows what is really printed."""

import doctest
from pathlib import Path

README = (Path(__file__).parents[3] / "README.md").read_text()


def test_what_python_prints_is_what_the_page_shows():
    page = README.split("## In Python\n")[1].split("\n## ")[0]
    shown: dict = {}
    code = page.split("Whatever one holds")[0]
    exec(compile("\n".join(line[4:] for line in code.splitlines() if line.startswith("    ")), "README.md", "exec"), shown)
    session = doctest.DocTestParser().get_doctest(page, shown, "README.md", "README.md", 0)
    told: list[str] = []
    assert doctest.DocTestRunner().run(session, out=told.append).failed == 0, "".join(told)
    assert len(session.examples) == 10
