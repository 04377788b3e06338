"""What editors are given: a folder for Visual Studio Code and a file for Neovim, which only start the server."""

import json
import re
from pathlib import Path

from casper.engine.domain.domain import FILES
from casper.engine.domain.examples import TESTS

EDITORS = Path(__file__).resolve().parents[2] / "editors"
PACKAGE = json.loads((EDITORS / "vscode" / "package.json").read_text())


def test_the_extension_starts_the_language_server():
    assert PACKAGE["contributes"]["configuration"]["properties"]["casper.command"]["default"] == ["casper", "lsp"]
    assert 'cmd = { "casper", "lsp" }' in (EDITORS / "neovim" / "casper.lua").read_text()


def test_both_take_every_file_of_a_domain():
    patterns = PACKAGE["contributes"]["languages"][0]["filenamePatterns"]
    assert patterns == [f"**/{name}" for name in (*FILES, TESTS)]
    assert all(f'"{name}"' in (EDITORS / "neovim" / "casper.lua").read_text() for name in (*FILES, TESTS))


def test_every_file_the_extension_names_is_there():
    contributed = PACKAGE["contributes"]
    named = [PACKAGE["main"], contributed["languages"][0]["configuration"], contributed["grammars"][0]["path"]]
    assert all((EDITORS / "vscode" / name).is_file() for name in named)
    json.loads((EDITORS / "vscode" / "language-configuration.json").read_text())


def test_the_grammar_tells_the_parts_of_a_clause_apart():
    grammar = json.loads((EDITORS / "vscode" / "syntaxes" / "casper.tmLanguage.json").read_text())
    rules = [(rule["name"], re.compile(rule.get("match") or rule["begin"])) for rule in grammar["patterns"]]

    def kind(text):
        return next(name for name, rule in rules if rule.match(text))

    assert kind("% a comment").startswith("comment") and kind('"a sentence"').startswith("string")
    assert (
        kind("Food").startswith("variable")
        and kind("eat(A)").startswith("entity")
        and kind("plate").startswith("constant")
    )
    assert (
        kind("-->").endswith("arrow.casper")
        and kind("\\+").endswith("negation.casper")
        and kind("never(").startswith("keyword")
    )
