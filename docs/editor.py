"""Draws what an editor shows of a domain with mistakes, from what the language server really says: docs/editor.svg.

python docs/editor.py
"""

import sys
import tempfile
from html import escape
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent / part) for part in ("src", "tests/lsp")]

from editor import Editor  # noqa: E402

ONTOLOGY = """\
human(ann).
robot(tia).
% Whoever can do something.
agent(X) :- human(X).
agent(X) :- robot(X).
cup(mug).

carry(A, T, D) :- agent(A), cpu(T), place(D).
place(table).
never("the mug stays in the room") :- claim(carry(_, T, D)), T = mug, D = garden.
say(carry(A, T, D), "{A} carries {What} to {D}").
setting(focus, thresold, 0.4).
greets(X, Y) :- agent(X).
"""
HOVERED, FURTHER = "agent(A)", 1
WIDTH, LINE, LETTER, LEFT, TOP = 1180, 22, 7.83, 52, 26
COLOURS = {1: "#c0392b", 2: "#b9770e", 3: "#2471a3"}  # by severity


def shown() -> tuple[list[tuple[int, int, int, int, str]], str]:
    """Each finding (line, first and last column, severity, message), and what hovering tells."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "ontology.pl"
        path.write_text(ONTOLOGY)
        editor = Editor()
        uri = editor.open(path)
        editor.findings(uri, lambda found: any("focus has" in each for each in found))
        found = []
        for each in editor.found[uri]:
            start, end = each.range.start, each.range.end
            found.append((start.line, start.character, end.character, int(each.severity), each.message))
        told = editor.hover(uri, HOVERED, FURTHER)
        editor.end()
    return found, told


def drawn(found: list[tuple[int, int, int, int, str]], told: str) -> str:
    """The text with its findings behind the lines, and the hover below the name."""
    lines = ONTOLOGY.splitlines()
    height = TOP + LINE * (len(lines) + 1)
    parts = [
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {height}" '
        'font-family="monospace" font-size="13">',
        f'<rect width="{WIDTH}" height="{height}" rx="6" fill="#fdfdfb" stroke="#ccc"/>',
    ]
    for at, text in enumerate(lines):
        y = TOP + LINE * at
        parts.append(f'<text x="{LEFT - 12}" y="{y}" text-anchor="end" fill="#aaa">{at + 1}</text>')
        colour = "#888" if text.startswith("%") else "#222"
        parts.append(_text(LEFT, y, text, colour))
    for line, first, last, severity, _ in found:
        y = TOP + LINE * line + 4
        parts.append(_wave(LEFT + first * LETTER, LEFT + max(last, first + 1) * LETTER, y, COLOURS[severity]))
    for line in sorted({each[0] for each in found}):
        first_of_line = min((e for e in found if e[0] == line), key=lambda e: e[3])
        where = LEFT + (len(lines[line]) + 3) * LETTER
        parts.append(_text(where, TOP + LINE * line, f"■ {_cut(first_of_line[4], where)}", COLOURS[first_of_line[3]]))
    parts += _hover(lines, told)
    return "\n".join([*parts, "</svg>\n"])


def _cut(message: str, where: float) -> str:
    most = int((WIDTH - where) / LETTER) - 4
    return message if len(message) <= most else f"{message[: most - 1]}…"


def _text(x: float, y: float, text: str, colour: str) -> str:
    width = f'xml:space="preserve" textLength="{len(text) * LETTER:.1f}"'
    return f'<text x="{x:.1f}" y="{y}" fill="{colour}" {width}>{escape(text)}</text>'


def _wave(start: float, end: float, y: float, colour: str) -> str:
    steps = "".join(f" q 1.5 {-3 if at % 2 else 3} 3 0" for at in range(max(int((end - start) / 3), 1)))
    return f'<path d="M {start:.1f} {y}{steps}" fill="none" stroke="{colour}"/>'


def _hover(lines: list[str], told: str) -> list[str]:
    """A box with what hovering over a name tells, on the right where the text leaves room."""
    rows = [
        row.strip("*") for row in told.replace("**", "").replace("```prolog", "").replace("```", "").split("\n") if row
    ]
    x, y = WIDTH - 470, TOP - 14
    box = f'<rect x="{x}" y="{y}" width="456" height="{LINE * len(rows) + 12}" rx="4" fill="#f2f2ee" stroke="#bbb"/>'
    return [box, *(_text(x + 12, y + 20 + LINE * at, row[:55], "#333") for at, row in enumerate(rows))]


if __name__ == "__main__":
    (HERE / "editor.svg").write_text(drawn(*shown()))
