"""What commands print, written anew onto the pages: ``python docs/refresh.py [FILE…]``. Look at the difference then.

A page is visited as the tests do (`tests/helpers/visits.py`). Of a command whose output the page does not show any
more, the lines that the page showed are looked for in what is printed now, numbers and bars aside: those are kept, what
stood for other lines (⋮) stays, and what is new between two of them is written between them. Notebooks are executed.
"""

from __future__ import annotations

import doctest
import re
import sys
import tempfile
from difflib import SequenceMatcher
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parent.parent / part) for part in ("src", "tests/helpers")]

from notebooks import NOTEBOOKS, executed  # noqa: E402
from pages import PAGES, ROOT, blocks_of  # noqa: E402
from visits import ANY_LINES, ANY_TEXT, Visit, assert_prints  # noqa: E402

_CHANGING = re.compile(r"[\d.,]+|[█▉▊▋▌▍▎▏ ]+")


def refresh(page: Path) -> int:
    """Write a page anew; how many commands print something else now."""
    with tempfile.TemporaryDirectory() as folder:
        visit, changed = Refreshing(Path(folder)), 0
        text = page.read_text()
        for block in blocks_of(page):
            visit.written = block.text
            if not block.why:
                visit.run(block)
            changed += visit.written != block.text
            text = text.replace(block.text, visit.written, 1)
        page.write_text(text)
    return changed


class Refreshing(Visit):
    """A visit that corrects what it finds; ``written`` is the block as it should be."""

    written = ""

    def compare(self, shown: str, printed: str, place: str) -> None:
        """Correct what is shown."""
        try:
            assert_prints(shown, printed, place)
        except AssertionError:
            print(place)
            self.written = self.written.replace(shown, refreshed(shown, printed), 1)

    def session(self, session: doctest.DocTest) -> None:
        """Correct what a session shows."""

        def wrong(out: object, test: doctest.DocTest, example: doctest.Example, got: str) -> None:
            print(f"{test.name}:{test.lineno}: {example.source}", end="")
            last = example.source.rstrip("\n").splitlines()[-1]
            self.written = self.written.replace(f"{last}\n{example.want}", f"{last}\n{got}", 1)

        runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
        runner.report_failure = wrong  # type: ignore[method-assign]
        runner.run(session, out=lambda text: None, clear_globs=False)


def refreshed(shown: str, printed: str) -> str:
    """What should be shown of what is printed."""
    old, new = shown.strip("\n").splitlines(), printed.rstrip("\n").splitlines()
    kept = [line for line in old if line.strip() != ANY_LINES]
    blocks = SequenceMatcher(
        None, [_aside(x) for x in kept], [_aside(x) for x in new], autojunk=False
    ).get_matching_blocks()
    pairs = {a + i: b + i for a, b, size in blocks for i in range(size)}
    lines: list[str] = []
    done, gap, at = 0, False, 0
    for line in old:
        if line.strip() == ANY_LINES:
            gap = True
            continue
        if at in pairs:
            found = pairs[at]
            skipped = new[done:found]
            lines += [next(x for x in old if x.strip() == ANY_LINES)] if gap and skipped else skipped
            lines.append(_shortened(line, new[found]))
            done, gap = found + 1, False
        at += 1
    rest = new[done:]
    lines += [next(x for x in old if x.strip() == ANY_LINES)] if gap and rest else rest
    return "".join(f"{line}\n" for line in lines)


def _aside(line: str) -> str:
    return _CHANGING.sub("#", line.partition(ANY_TEXT)[0])


def _shortened(shown: str, printed: str) -> str:
    """The printed line, cut where the page had cut it."""
    before, cut, _ = shown.partition(ANY_TEXT)
    return printed[: len(before)] + cut if cut and shown.endswith(ANY_TEXT) else printed


def execute(file: Path) -> None:
    """Write the outputs of a notebook anew."""
    import nbformat

    notebook = nbformat.read(file, 4)
    with tempfile.TemporaryDirectory() as folder:
        nbformat.write(executed(notebook, folder), file)


if __name__ == "__main__":
    for each in [ROOT / name for name in sys.argv[1:]] or [*PAGES, *NOTEBOOKS]:
        (execute if each.suffix == ".ipynb" else refresh)(each)
