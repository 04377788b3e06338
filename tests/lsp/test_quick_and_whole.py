"""What is told at once is what the whole check says: nothing that it does not find, at no other place."""

import random
from pathlib import Path

import pytest

from casper.engine.domain.check import check_domain
from casper.lsp.documents import document
from casper.lsp.quick import kept, quick_findings, still
from casper.lsp.workspace import Workspace

KITCHEN = Path(__file__).resolve().parents[2] / "domains" / "kitchen"
FILES = ["ontology.pl", "plans.pl", "words.pl"]
MISTAKES = {
    "ontology.pl": [
        ("wave(X) :- humn(X).\n", 1), ("wave(X) :- human(X\n", 1), ("wave(X, Y) :- human(X).\n", 1), ("claim(x).\n", 1),
        ("wave(X) :- human(X), X > foo + 1.\n", 1), ("wave(X) :- \\+ human(X), (agent(X) ; robt(X)).\n", 1),
        ('say(human(X), "{Y}").\n', 1), ('say(humen(X), "{X}").\n', 1), ("never(x) :- human(Y), \\+ item(Z).\n", 1),
        (":- dynamik(a/1).\n", 1), ("go(X) :- forall(human(X), itm(X)).\n", 1),
    ],
    "plans.pl": [("clean(V) --> wsh(V, sink).\n", 1), ("tidy --> tidy.\n", 1), ("goal(brekfast(F)) :- meal(F).\n", 0), ("x --> y(, z.\n", 1)],
    "words.pl": [('say(fr, humann(X), "{X}").\n', 1), ('say(fr, never("the biscuits"), "…").\n', 1)],
}  # fmt: skip


def told(findings):
    return {(Path(f.place.file).name, f.place.line, str(f.severity), f.message) for f in findings}


def spoilt(folder, file, more, seed):
    """The kitchen with a mistake, at the end or at the start of a line of one file."""
    for each in KITCHEN.glob("*.pl"):
        (folder / each.name).write_text(each.read_text())
    path = folder / file
    lines = path.read_text().splitlines(keepends=True)
    starts = [at for at, line in enumerate(lines) if not line.startswith((" ", "\t"))]
    at = random.Random(seed).choice([*starts, len(lines)])
    path.write_text("".join([*lines[:at], more, *lines[at:]]))
    workspace = Workspace()
    workspace.open[path] = path.read_text()
    return workspace.domain_of(path)


@pytest.mark.parametrize(("file", "more", "least"), [(f, m, n) for f in FILES for m, n in MISTAKES[f]])
def test_what_is_told_at_once_the_whole_check_says_too(file, more, least, tmp_path):
    domain = spoilt(tmp_path, file, more, seed=len(more))
    at_once, whole = told(quick_findings(domain)), told(check_domain(tmp_path))
    assert at_once <= whole and len(at_once) >= least


def test_what_the_whole_check_found_comes_back_as_it_was(tmp_path):
    domain = spoilt(tmp_path, "ontology.pl", "lonely(x).\nwave(X, Y) :- human(X).\n", seed=2)
    whole = check_domain(tmp_path)
    assert told(still(kept(whole, domain), domain)) == told(whole)


def test_a_clause_is_analysed_once_wherever_it_moves_to(tmp_path):
    text = (KITCHEN / "ontology.pl").read_text()
    before, after = document(tmp_path / "a.pl", text), document(tmp_path / "a.pl", f"% more\n\n{text}")
    assert [piece for _, piece in before.pieces] == [piece for _, piece in after.pieces]
    assert [start + 8 for start, _ in before.pieces] == [start for start, _ in after.pieces]
