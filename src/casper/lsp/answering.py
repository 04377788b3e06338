"""What the protocol asks, answered of the workspace; knows of no connection."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable, Mapping
from pathlib import Path

from lsprotocol import types as lsp
from pygls import uris

from casper.kb.checks.finding import Finding
from casper.lsp.changing import Edit, renamed, repairs_of, uses_of
from casper.lsp.completing import Kind, proposals
from casper.lsp.documents import Document
from casper.lsp.outline import Part, outline
from casper.lsp.telling import hover_text
from casper.lsp.workspace import Domain, Use

SOURCE = "casper"
_SEVERITIES = {
    "error": lsp.DiagnosticSeverity.Error,
    "warning": lsp.DiagnosticSeverity.Warning,
    "note": lsp.DiagnosticSeverity.Information,
}
_KINDS: Mapping[Kind, lsp.CompletionItemKind] = {
    "predicate": lsp.CompletionItemKind.Function,
    "action": lsp.CompletionItemKind.Method,
    "task": lsp.CompletionItemKind.Class,
    "thing": lsp.CompletionItemKind.Value,
    "variable": lsp.CompletionItemKind.Variable,
    "setting": lsp.CompletionItemKind.Property,
    "word": lsp.CompletionItemKind.Keyword,
    "built-in": lsp.CompletionItemKind.Function,
}
_SYMBOLS = {
    "task": lsp.SymbolKind.Class,
    "step": lsp.SymbolKind.Method,
    "predicate": lsp.SymbolKind.Function,
    "constraint": lsp.SymbolKind.Event,
}


def uri_of(path: Path) -> str:
    """The address of a file."""
    return uris.from_fs_path(str(path)) or str(path)


def span(doc: Document, start: int, end: int) -> lsp.Range:
    """Two offsets as the editor counts them."""
    (line, column), (last, end_column) = doc.lines.position(start), doc.lines.position(end)
    return lsp.Range(lsp.Position(line, column), lsp.Position(last, end_column))


def diagnostics(doc: Document, findings: Iterable[Finding]) -> list[lsp.Diagnostic]:
    """The findings of one text."""
    return [_diagnostic(doc, each) for each in findings if each.place.file == str(doc.path)]


def _diagnostic(doc: Document, finding: Finding) -> lsp.Diagnostic:
    start, end = extent(doc, finding)
    return lsp.Diagnostic(
        range=span(doc, start, end), message=finding.message, severity=_SEVERITIES[finding.severity], source=SOURCE
    )


def extent(doc: Document, finding: Finding) -> tuple[int, int]:
    """Where a finding begins and ends: the name there, or the rest of its line."""
    start = doc.lines.of_place(finding.place.line, finding.place.column)
    if finding.place.column:
        found = doc.name_at(start)
        if found is not None and found[0] + found[1].start == start:
            return start, found[0] + found[1].end
    rest = doc.text[start:].split("\n", 1)[0].rstrip()
    return start, start + len(rest)


def completions(domain: Domain, doc: Document, offset: int) -> lsp.CompletionList:
    """What may be typed at an offset."""
    items = [
        lsp.CompletionItem(
            label=each.text,
            kind=_KINDS[each.kind],
            detail=each.detail or None,
            documentation=lsp.MarkupContent(lsp.MarkupKind.Markdown, each.about) if each.about else None,
        )
        for each in proposals(domain, doc, offset)
    ]
    return lsp.CompletionList(is_incomplete=False, items=items)


def hover(domain: Domain, doc: Document, offset: int, rows: Mapping[str, int]) -> lsp.Hover | None:
    """What is told of the name at an offset."""
    found = doc.name_at(offset)
    told = "" if found is None else hover_text(domain, found[1], rows)
    if found is None or not told:
        return None
    start, name = found
    content = lsp.MarkupContent(lsp.MarkupKind.Markdown, told)
    return lsp.Hover(content, span(doc, start + name.start, start + name.end))


def definitions(domain: Domain, doc: Document, offset: int) -> list[lsp.Location]:
    """Where the name at an offset is defined; a variable where it stands first."""
    found = doc.name_at(offset)
    if found is None:
        return []
    if found[1].role == "variable":
        return _locations(uses_of(domain, doc, offset)[:1])
    return _locations(domain.definitions(domain.symbol(found[1])))


def references(domain: Domain, doc: Document, offset: int) -> list[lsp.Location]:
    """Every use of the name at an offset."""
    return _locations(uses_of(domain, doc, offset))


def _locations(uses: Iterable[Use]) -> list[lsp.Location]:
    return [lsp.Location(uri_of(use.doc.path), span(use.doc, use.start, use.end)) for use in uses]


def rename(domain: Domain, doc: Document, offset: int, new: str) -> lsp.WorkspaceEdit:
    """The changes that give the name at an offset another name.

    Raises:
        CasperError: it cannot have that name.
    """
    return _changes(domain, renamed(domain, doc, offset, new))


def _changes(domain: Domain, edits: Iterable[Edit]) -> lsp.WorkspaceEdit:
    docs = {doc.path: doc for doc in domain.docs}
    found: dict[str, list[lsp.TextEdit]] = defaultdict(list)
    for edit in dict.fromkeys(edits):
        found[uri_of(edit.path)].append(lsp.TextEdit(span(docs[edit.path], edit.start, edit.end), edit.text))
    return lsp.WorkspaceEdit(changes=dict(found))


def actions(domain: Domain, doc: Document, given: Iterable[lsp.Diagnostic]) -> list[lsp.CodeAction]:
    """Repairs of the findings that the editor asks about."""
    found = []
    for each in given:
        start = doc.lines.offset(each.range.start.line, each.range.start.character)
        end = doc.lines.offset(each.range.end.line, each.range.end.character)
        for repair in repairs_of(doc, start, end, each.message):
            edit = _changes(domain, [repair.edit])
            found.append(lsp.CodeAction(repair.title, kind=lsp.CodeActionKind.QuickFix, diagnostics=[each], edit=edit))
    return found


def symbols(doc: Document) -> list[lsp.DocumentSymbol]:
    """The outline of a text."""
    return [_symbol(doc, part) for part in outline(doc)]


def _symbol(doc: Document, part: Part) -> lsp.DocumentSymbol:
    where = span(doc, part.start, part.end)
    children = [_symbol(doc, each) for each in part.parts]
    return lsp.DocumentSymbol(part.name, _SYMBOLS[part.kind], where, where, children=children)
