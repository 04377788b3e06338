"""Whatever is typed, the server goes on: random edits, after each of which everything is asked that an editor may ask."""

import os
import random
from contextlib import suppress
from pathlib import Path

import pytest

pytest.importorskip("pygls")

from lsprotocol import types as lsp

from casper.kb.errors import CasperError
from casper.lsp import answering
from casper.lsp.changing import renamed
from casper.lsp.documents import document
from casper.lsp.quick import kept, quick_findings, still
from casper.lsp.workspace import Workspace

KITCHEN = Path(__file__).resolve().parents[2] / "domains" / "kitchen"
EDITS = 10_000 if os.environ.get("HYPOTHESIS_PROFILE") == "thorough" else 150
PIECES = [
    *"()[]{},.:-|!;'\"`\\%_X0 \n\t\r", ":- ", "-->", "\\+ ", "/*", "*/", "0'", "'\\x", ". ", ".\n", "say(", "{X}", "\u2028", "\U0001f375",
    "\ud800", "\0", ":- op(700, xfx, likes).\n", ':- include("plans.pl").\n', ":- use(kitchen, as(k)).\n", "f(" * 50, "a, " * 50, "é", "never(", "setting(focus, ", "by(",
]  # fmt: skip


class Typist:
    """Changes a text a little, at random: types, deletes, moves and repeats pieces of it."""

    def __init__(self, text, seed):
        self.text, self.chance, self.first = text, random.Random(seed), text

    def edit(self):
        start = self.chance.randrange(len(self.text) + 1)
        end = min(len(self.text), start + self.chance.choice([0, 0, 0, 1, 2, 10, 200]))
        kind = self.chance.random()
        new = self.chance.choice(PIECES) if kind < 0.7 else self.text[start:end] * 2 if kind < 0.85 else ""
        self.text = self.text[:start] + new + self.text[end:]
        if len(self.text) > 2 * len(self.first) or self.chance.random() < 0.01:
            self.text = self.first
        return self.text


def ask_everything(workspace, path, chance):
    """All that an editor may ask of a text."""
    domain, doc = workspace.domain_of(path), workspace.document(path)
    found = quick_findings(domain)
    list(still(kept(found, domain), domain))
    given = answering.diagnostics(doc, found)
    for each in given:
        assert (each.range.start.line, each.range.start.character) <= (each.range.end.line, each.range.end.character)
    offset = chance.randrange(len(doc.text) + 1)
    line, column = doc.lines.position(offset)
    assert doc.lines.offset(line, column) <= offset
    answering.completions(domain, doc, offset)
    answering.hover(domain, doc, offset, {})
    answering.definitions(domain, doc, offset)
    answering.references(domain, doc, offset)
    answering.symbols(doc)
    answering.actions(domain, doc, given[:3])
    with suppress(CasperError):
        renamed(domain, doc, offset, chance.choice(["fresh", "Fresh", "'a b'", "", "eat"]))


@pytest.mark.parametrize("file", ["ontology.pl", "plans.pl", "words.pl"])
def test_no_edit_is_too_odd(file, tmp_path):
    for each in KITCHEN.glob("*.pl"):
        (tmp_path / each.name).write_text(each.read_text())
    workspace, path, chance = Workspace(), tmp_path / file, random.Random(1)
    typist = Typist(path.read_text(), 7)
    for _ in range(EDITS // 3 + 1):
        workspace.open[path] = typist.edit()
        ask_everything(workspace, path, chance)


def test_a_text_typed_letter_by_letter_reads_in_the_end_as_it_is(tmp_path):
    text = 'agent(X) :- human(X).\nsay(agent(X), "{X} acts").\ngo(P) --> {agent(P)}, optional(walk(P)).\n'
    for at in range(len(text)):
        document(tmp_path / "a.pl", text[:at])
    doc = document(tmp_path / "a.pl", text)
    assert [len(piece.sentences) for _, piece in doc.pieces] == [1, 1, 1]
    assert [f for _, piece in doc.pieces for f in piece.findings] == []


def test_the_server_answers_after_odd_edits(editor, home):
    uri = editor.open(home / "ontology.pl")
    typist = Typist(editor.texts[uri], 3)
    for _ in range(40):
        editor.change(uri, typist.edit().replace("\ud800", ""))
    editor.change(uri, typist.first + "wave(X) :- humn(X).\n")
    assert editor.findings(uri, lambda found: found == ["nothing defines humn/1; did you mean human?"])
    asked = lsp.HoverParams(lsp.TextDocumentIdentifier("untitled:Untitled-1"), lsp.Position(3, 3))
    assert editor.wait(editor.client.text_document_hover_async(asked)) is None
