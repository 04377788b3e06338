"""An editor without a window: pygls' client, driven step by step from tests."""

from __future__ import annotations

import asyncio
import sys
import threading
from collections import defaultdict
from pathlib import Path
from typing import Any

from lsprotocol import types as lsp
from pygls import uris
from pygls.lsp.client import LanguageClient

PATIENCE = 60.0  # seconds: machines are busy


class Editor:
    """Opens and changes texts, asks about places in them, and keeps what the server tells."""

    def __init__(self) -> None:
        self.loop = asyncio.new_event_loop()
        self.thread = threading.Thread(target=self.loop.run_forever, daemon=True)
        self.thread.start()
        self.found: dict[str, list[lsp.Diagnostic]] = {}
        self.told: defaultdict[str, int] = defaultdict(int)  # how often findings of a text came
        self.logged: list[str] = []
        self.versions: defaultdict[str, int] = defaultdict(int)
        self.texts: dict[str, str] = {}
        self.client = LanguageClient("tests", "1")
        self._listen()
        self.wait(self._start())

    def wait(self, coroutine: Any) -> Any:
        return asyncio.run_coroutine_threadsafe(coroutine, self.loop).result(PATIENCE)

    async def _start(self) -> None:
        self.heard = asyncio.Condition()
        await self.client.start_io(sys.executable, "-m", "casper", "lsp")
        params = lsp.InitializeParams(capabilities=lsp.ClientCapabilities(), process_id=None, root_uri=None)
        self.capabilities = (await self.client.initialize_async(params)).capabilities
        self.client.initialized(lsp.InitializedParams())

    def _listen(self) -> None:
        @self.client.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        async def diagnosed(params: lsp.PublishDiagnosticsParams) -> None:
            async with self.heard:
                self.found[params.uri] = list(params.diagnostics)
                self.told[params.uri] += 1
                self.heard.notify_all()

        @self.client.feature(lsp.WINDOW_LOG_MESSAGE)
        def logged(params: lsp.LogMessageParams) -> None:
            self.logged.append(params.message)

    # --- texts ---------------------------------------------------------------------------------------------------------

    def open(self, path: Path, text: str | None = None) -> str:
        uri = uris.from_fs_path(str(path))
        self.texts[uri] = path.read_text() if text is None else text
        item = lsp.TextDocumentItem(uri=uri, language_id="casper", version=0, text=self.texts[uri])
        self.client.text_document_did_open(lsp.DidOpenTextDocumentParams(item))
        return uri

    def change(self, uri: str, text: str) -> None:
        self.texts[uri], self.versions[uri] = text, self.versions[uri] + 1
        where = lsp.VersionedTextDocumentIdentifier(uri=uri, version=self.versions[uri])
        changes = [lsp.TextDocumentContentChangeWholeDocument(text)]
        self.client.text_document_did_change(lsp.DidChangeTextDocumentParams(where, changes))

    def close(self, uri: str) -> None:
        self.client.text_document_did_close(lsp.DidCloseTextDocumentParams(lsp.TextDocumentIdentifier(uri)))

    def findings(self, uri: str, until: Any = lambda messages: True) -> list[str]:
        """The messages of a text, once they are as wanted."""

        async def waited() -> list[str]:
            async with self.heard:
                await asyncio.wait_for(
                    self.heard.wait_for(lambda: uri in self.found and until(self._messages(uri))), PATIENCE
                )
            return self._messages(uri)

        return self.wait(waited())

    def _messages(self, uri: str) -> list[str]:
        return [each.message for each in self.found.get(uri, ())]

    # --- questions -----------------------------------------------------------------------------------------------------

    def place(self, uri: str, mark: str, further: int = 0) -> tuple[lsp.TextDocumentIdentifier, lsp.Position]:
        """The place of the first occurrence of a piece of text, so many characters further."""
        offset = self.texts[uri].index(mark) + further
        before = self.texts[uri][:offset].split("\n")
        return lsp.TextDocumentIdentifier(uri), lsp.Position(len(before) - 1, len(before[-1].encode("utf-16-le")) // 2)

    def completions(self, uri: str, mark: str) -> dict[str, lsp.CompletionItem]:
        """What may stand behind a piece of text."""
        asked = lsp.CompletionParams(*self.place(uri, mark, len(mark)))
        return {item.label: item for item in self.wait(self.client.text_document_completion_async(asked)).items}

    def hover(self, uri: str, mark: str, further: int = 0) -> str:
        found = self.wait(self.client.text_document_hover_async(lsp.HoverParams(*self.place(uri, mark, further))))
        return "" if found is None else found.contents.value

    def definition(self, uri: str, mark: str, further: int = 0) -> list[str]:
        found = self.wait(
            self.client.text_document_definition_async(lsp.DefinitionParams(*self.place(uri, mark, further)))
        )
        return [self.shown(each) for each in found]

    def references(self, uri: str, mark: str, further: int = 0) -> list[str]:
        asked = lsp.ReferenceParams(lsp.ReferenceContext(True), *self.place(uri, mark, further))
        return [self.shown(each) for each in self.wait(self.client.text_document_references_async(asked))]

    def rename(self, uri: str, mark: str, new: str, further: int = 0) -> dict[str, str]:
        """The texts after a renaming, by the name of the file."""
        document, position = self.place(uri, mark, further)
        edit = self.wait(self.client.text_document_rename_async(lsp.RenameParams(document, position, new)))
        return {uri.rsplit("/", 1)[-1]: self.edited(uri, edits) for uri, edits in edit.changes.items()}

    def repairs(self, uri: str) -> dict[str, str]:
        """What the repairs of all findings would make of the text, by their titles."""
        document = lsp.TextDocumentIdentifier(uri)
        found = {}
        for each in self.found[uri]:
            asked = lsp.CodeActionParams(document, each.range, lsp.CodeActionContext([each]))
            for action in self.wait(self.client.text_document_code_action_async(asked)):
                found[action.title] = self.edited(uri, action.edit.changes[uri])
        return found

    def outline(self, uri: str) -> list[lsp.DocumentSymbol]:
        asked = lsp.DocumentSymbolParams(lsp.TextDocumentIdentifier(uri))
        return self.wait(self.client.text_document_document_symbol_async(asked))

    def shown(self, location: lsp.Location) -> str:
        """A place as ``file:line: text``."""
        path = Path(uris.to_fs_path(location.uri))
        lines = self.texts.get(location.uri, path.read_text() if path.exists() else "").split("\n")
        return f"{path.name}:{location.range.start.line + 1}: {lines[location.range.start.line].strip()}"

    def edited(self, uri: str, edits: list[lsp.TextEdit]) -> str:
        text = self.texts.get(uri) or Path(uris.to_fs_path(uri)).read_text()
        lines = text.split("\n")
        for edit in sorted(edits, key=lambda e: (e.range.start.line, e.range.start.character), reverse=True):
            line = lines[edit.range.start.line].encode("utf-16-le")
            before, after = line[: edit.range.start.character * 2], line[edit.range.end.character * 2 :]
            lines[edit.range.start.line] = before.decode("utf-16-le") + edit.new_text + after.decode("utf-16-le")
        return "\n".join(lines)

    def end(self) -> None:
        self.wait(self.client.shutdown_async(None))
        self.client.exit(None)
        self.wait(self.client.stop())
        self.loop.call_soon_threadsafe(self.loop.stop)
