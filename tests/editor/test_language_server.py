"""``aegis-ot lsp``, driven by pygls' own client over stdio."""

from __future__ import annotations

import asyncio
import sys
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager
from pathlib import Path

import pytest

pytest.importorskip("pygls", reason="pygls is not installed: extra editor")

from lsprotocol import types
from pygls.lsp.client import LanguageClient

from tests.cli.test_check_command import BAD_LINE, protocol
from tests.workbench.test_fixing import UNNAMED

_PATIENCE_S = 200.0


class Editor:
    """A client with one text open, and what the server last said of it."""

    def __init__(self, client: LanguageClient, path: Path) -> None:
        self._client = client
        self._uri = path.as_uri()
        self._told: asyncio.Queue[types.PublishDiagnosticsParams] = asyncio.Queue()
        self._version = 0

        @client.feature(types.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)
        def hear(params: types.PublishDiagnosticsParams) -> None:
            self._told.put_nowait(params)

    def open(self, text: str) -> None:
        item = types.TextDocumentItem(self._uri, "python", self._version, text)
        self._client.text_document_did_open(types.DidOpenTextDocumentParams(item))

    def type(self, *texts: str) -> None:
        """One text after another, none with time to be judged but the last."""
        for text in texts:
            self._version += 1
            self._client.text_document_did_change(
                types.DidChangeTextDocumentParams(
                    types.VersionedTextDocumentIdentifier(self._version, self._uri),
                    [types.TextDocumentContentChangeWholeDocument(text)],
                )
            )

    async def told(self) -> list[types.Diagnostic]:
        """What is said of the text as it stands."""
        while True:
            params = await asyncio.wait_for(self._told.get(), _PATIENCE_S)
            if params.version == self._version:
                return list(params.diagnostics)

    async def fixes(self, about: types.Diagnostic) -> list[types.CodeAction]:
        found = await self._client.text_document_code_action_async(
            types.CodeActionParams(
                types.TextDocumentIdentifier(self._uri),
                about.range,
                types.CodeActionContext([about]),
            )
        )
        return [one for one in found or [] if isinstance(one, types.CodeAction)]

    def with_edits(self, text: str, action: types.CodeAction) -> str:
        """The text as an editor changes it."""
        assert action.edit
        assert action.edit.changes
        lines = text.splitlines(keepends=True)

        def offset(place: types.Position) -> int:
            return sum(map(len, lines[: place.line])) + place.character

        for edit in reversed(action.edit.changes[self._uri]):
            start, end = offset(edit.range.start), offset(edit.range.end)
            text = text[:start] + edit.new_text + text[end:]
        return text


@asynccontextmanager
async def editing(path: Path) -> AsyncIterator[Editor]:
    client = LanguageClient("test", "1")
    await client.start_io(sys.executable, "-m", "aegis_ot", "lsp")
    await client.initialize_async(
        types.InitializeParams(capabilities=types.ClientCapabilities(), root_uri=None)
    )
    client.initialized(types.InitializedParams())
    yield Editor(client, path)
    await client.shutdown_async(None)
    client.exit(None)
    await client.stop()


@pytest.mark.timeout(500)
def test_findings_as_one_types_and_quick_fixes(tmp_path: Path) -> None:
    path = protocol(tmp_path / "µ set-up.py", tips="once")
    text = path.read_text(encoding="utf-8")

    async def session() -> None:
        async with editing(path) as editor:
            editor.open(text)
            (finding,) = await editor.told()
            assert (finding.code, finding.severity) == ("PCR-3", types.DiagnosticSeverity.Error)
            assert finding.range.start == types.Position(BAD_LINE - 1, 4)
            fresh, waiver = await editor.fixes(finding)
            assert "fresh tip" in fresh.title
            assert fresh.is_preferred
            editor.type("def run(", editor.with_edits(text, fresh))
            assert await editor.told() == [], "only the last text is judged"
            waived = editor.with_edits(text, waiver)
            editor.type(waived)
            _, remark = sorted(await editor.told(), key=lambda one: one.severity or 0)
            assert "gives no reason" in remark.message
            editor.type(waived.replace("ignore[PCR-3] ", "ignore[PCR-3] one donor"))
            assert await editor.told() == []
            editor.type(UNNAMED)
            open_ = await editor.told()
            assert {one.code for one in open_} == {"PCR-2", "PCR-4"}
            (role,) = await editor.fixes(open_[0])
            assert '@guard(roles={"ntc": ["1:C1"]})\ndef run' in editor.with_edits(UNNAMED, role)
            editor.type("def run(p:\n    opentrons\n# apiLevel\n")
            (broken,) = await editor.told()
            assert "cannot be judged" in broken.message
            editor.type("print('no protocol')\n")
            assert await editor.told() == []

    asyncio.run(session())
