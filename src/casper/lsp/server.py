"""The connection: what the editor tells and asks, by the Language Server Protocol on standard input and output."""

from __future__ import annotations

import asyncio
import logging
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls import uris
from pygls.exceptions import JsonRpcException
from pygls.lsp.server import LanguageServer

from casper import __version__
from casper.kb.checks.finding import Finding, sorted_findings
from casper.kb.errors import CasperError
from casper.lsp import answering
from casper.lsp.documents import Document
from casper.lsp.quick import Kept, kept, quick_findings, still
from casper.lsp.whole import WholeCheck
from casper.lsp.workspace import Domain, Workspace

REST = 0.4  # seconds without typing before everything is checked
_REFUSED = -32803  # RequestFailed


class Server(LanguageServer):
    """Keeps the texts, what was found of them, and the process that checks everything."""

    def __init__(self, rest: float = REST) -> None:
        super().__init__("casper", __version__, text_document_sync_kind=lsp.TextDocumentSyncKind.Full)
        self.texts, self.rest = Workspace(), rest
        self.addresses: dict[Path, str] = {}  # of the open texts
        self.rows: dict[Path, dict[str, int]] = {}  # by folder
        self.kept: dict[Path, Kept] = {}  # what the whole check found last, by folder
        self.checks: dict[Path, asyncio.Task[None]] = {}
        self.whole = WholeCheck()
        self.is_checking = asyncio.Lock()

    def take(self, uri: str, text: str) -> None:
        """A text as it is now in the editor."""
        path = path_of(uri)
        self.addresses[path] = uri
        self.texts.encoding = str(getattr(self.workspace.position_encoding, "value", "utf-16"))
        self.texts.open[path] = text
        self.tell(self.texts.domain_of(path))
        self.check_later(path)

    def forget(self, uri: str) -> None:
        """A text is no longer open."""
        path = path_of(uri)
        self.texts.open.pop(path, None)
        address = self.addresses.pop(path, uri)
        self.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri=address, diagnostics=[]))

    def at(self, uri: str, position: lsp.Position) -> tuple[Domain, Document, int] | None:
        """The domain, the text and the offset that a question is about; None where the text is not open."""
        path = path_of(uri)
        if path not in self.texts.open:
            return None
        domain, doc = self.texts.domain_of(path), self.texts.document(path)
        return domain, doc, doc.lines.offset(position.line, position.character)

    def tell(self, domain: Domain) -> None:
        """Publish what is wrong with the open texts of a domain."""
        key = _key(domain)
        found = quick_findings(domain)
        if key in self.kept:
            found = _together(found, list(still(self.kept[key], domain)))
        for doc in domain.docs:
            uri = self.addresses.get(doc.path)
            if uri is not None:
                shown = answering.diagnostics(doc, found)
                self.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri=uri, diagnostics=shown))

    def check_later(self, path: Path) -> None:
        """Check everything once the typing rests."""
        key = _key(self.texts.domain_of(path))
        running = self.checks.get(key)
        if running is not None:
            running.cancel()
        self.checks[key] = asyncio.get_running_loop().create_task(self._check(path, key))

    async def _check(self, path: Path, key: Path) -> None:
        await asyncio.sleep(self.rest)
        async with self.is_checking:
            asked = self.texts.domain_of(path)
            found = await self.whole.run(asked, dict(self.texts.open))
            if found is None:
                sentence = "the whole check took too long and was given up; shown is what can be told at once"
                self.window_log_message(lsp.LogMessageParams(lsp.MessageType.Warning, sentence))
                return
            self.kept[key] = kept(found.findings, asked)
            if found.rows:
                self.rows[key] = found.rows
            self.tell(self.texts.domain_of(path))


def path_of(uri: str) -> Path:
    """The file of an address; of one that is no file a name for it."""
    return Path(uris.to_fs_path(uri) or uri.replace(":", "_"))


def _key(domain: Domain) -> Path:
    return domain.folder if domain.is_domain or not domain.docs else domain.docs[0].path


def _together(quick: list[Finding], whole: list[Finding]) -> list[Finding]:
    """Both, each once: what is told at once of a place wins over what was told of it before."""
    places = {(f.place.file, f.place.line, f.message) for f in quick}
    return sorted_findings([*quick, *(f for f in whole if (f.place.file, f.place.line, f.message) not in places)])


def server(rest: float = REST) -> Server:
    """A server that answers; ``rest`` are the seconds without typing before everything is checked."""
    made = Server(rest)

    @made.feature(lsp.TEXT_DOCUMENT_DID_OPEN)
    def opened(params: lsp.DidOpenTextDocumentParams) -> None:
        made.take(params.text_document.uri, params.text_document.text)

    @made.feature(lsp.TEXT_DOCUMENT_DID_CHANGE)
    def changed(params: lsp.DidChangeTextDocumentParams) -> None:
        uri = params.text_document.uri
        made.take(uri, made.workspace.get_text_document(uri).source)

    @made.feature(lsp.TEXT_DOCUMENT_DID_CLOSE)
    def closed(params: lsp.DidCloseTextDocumentParams) -> None:
        made.forget(params.text_document.uri)

    @made.feature(lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES)
    def moved(params: lsp.DidChangeWatchedFilesParams) -> None:
        for path in {path_of(change.uri).parent for change in params.changes}:
            for each in [file for file in made.texts.open if file.parent == path][:1]:
                made.tell(made.texts.domain_of(each))
                made.check_later(each)

    @made.feature(lsp.SHUTDOWN)
    def stopped(params: Any) -> None:
        made.whole.stop()

    _questions(made)
    return made


def _questions(made: Server) -> None:
    """What the editor asks about a place in a text."""

    @made.feature(lsp.TEXT_DOCUMENT_COMPLETION, lsp.CompletionOptions(trigger_characters=["(", ","]))
    def completion(params: lsp.CompletionParams) -> lsp.CompletionList | None:
        at = made.at(params.text_document.uri, params.position)
        return None if at is None else answering.completions(*at)

    @made.feature(lsp.TEXT_DOCUMENT_HOVER)
    def hover(params: lsp.HoverParams) -> lsp.Hover | None:
        at = made.at(params.text_document.uri, params.position)
        return None if at is None else answering.hover(*at, made.rows.get(_key(at[0]), {}))

    @made.feature(lsp.TEXT_DOCUMENT_DEFINITION)
    def definition(params: lsp.DefinitionParams) -> list[lsp.Location]:
        at = made.at(params.text_document.uri, params.position)
        return [] if at is None else answering.definitions(*at)

    @made.feature(lsp.TEXT_DOCUMENT_REFERENCES)
    def references(params: lsp.ReferenceParams) -> list[lsp.Location]:
        at = made.at(params.text_document.uri, params.position)
        return [] if at is None else answering.references(*at)

    @made.feature(lsp.TEXT_DOCUMENT_RENAME)
    def rename(params: lsp.RenameParams) -> lsp.WorkspaceEdit | None:
        at = made.at(params.text_document.uri, params.position)
        try:
            return None if at is None else answering.rename(*at, params.new_name)
        except CasperError as mistake:
            raise JsonRpcException(message=mistake.sentence, code=_REFUSED) from None

    @made.feature(lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL)
    def symbols(params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
        at = made.at(params.text_document.uri, lsp.Position(0, 0))
        return [] if at is None else answering.symbols(at[1])

    @made.feature(lsp.TEXT_DOCUMENT_CODE_ACTION, lsp.CodeActionOptions(code_action_kinds=[lsp.CodeActionKind.QuickFix]))
    def actions(params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
        at = made.at(params.text_document.uri, params.range.start)
        return [] if at is None else answering.actions(at[0], at[1], params.context.diagnostics)


def serve() -> None:
    """Answer on standard input and output until the editor ends it."""
    logging.basicConfig(level=logging.ERROR)  # on standard error; the output is the protocol's
    server().start_io()
