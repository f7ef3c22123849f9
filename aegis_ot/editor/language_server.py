"""``aegis-ot lsp``: diagnostics of Layer 1 as one types, and quick fixes, for any editor."""

from __future__ import annotations

import asyncio
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

from lsprotocol import types
from pygls.lsp.server import LanguageServer
from pygls.uris import to_fs_path
from pygls.workspace import TextDocument

from .. import __version__
from ..errors import AegisError
from ..vocabulary import Severity
from ..workbench import CheckedProtocol
from ..workbench.api import checked_protocol
from ..workbench.mending import Edit, Mend, mends_of
from ..workbench.shelf import is_protocol

SOURCE = "aegis-ot"

_REST_S = 0.5
"""How long nobody may type before a text is rehearsed, s."""


@dataclass(frozen=True)
class _Judged:
    """What was said of one version of a text."""

    text: str
    mends: tuple[Mend, ...]


class _Desk:
    """The texts that are open, and the check that each waits for."""

    def __init__(self, server: LanguageServer) -> None:
        self._server = server
        self._waiting: dict[str, asyncio.Task[None]] = {}
        self._judged: dict[str, _Judged] = {}
        self._one_at_a_time = asyncio.Lock()

    def changed(self, uri: str, rest_s: float = _REST_S) -> None:
        """A text is another; it is judged once nobody types any more."""
        before = self._waiting.pop(uri, None)
        if before is not None:
            before.cancel()
        self._waiting[uri] = asyncio.ensure_future(self._judge_soon(uri, rest_s))

    def closed(self, uri: str) -> None:
        """Nobody looks at it any more."""
        before = self._waiting.pop(uri, None)
        if before is not None:
            before.cancel()
        self._judged.pop(uri, None)
        self._publish(uri, None, [])

    def mends(self, document: TextDocument) -> tuple[Mend, ...]:
        """Those of the text as it stands; none while it waits to be judged."""
        judged = self._judged.get(document.uri)
        return judged.mends if judged is not None and judged.text == document.source else ()

    async def _judge_soon(self, uri: str, rest_s: float) -> None:
        await asyncio.sleep(rest_s)
        async with self._one_at_a_time:
            document = self._server.workspace.get_text_document(uri)
            text, version = document.source, document.version
            path = to_fs_path(uri)
            if path is None or not is_protocol(text):
                self._publish(uri, version, [])
                return
            try:
                checked = await asyncio.to_thread(checked_protocol, text, Path(path))
            except AegisError as error:
                told = _diagnostic(self._server, document, None, str(error))
                self._publish(uri, version, [told])
                return
            if document.version != version:  # the next check is on its way
                return
            mends = mends_of(text, checked.report) if checked.report is not None else []
            self._judged[uri] = _Judged(text, tuple(mends))
            self._publish(uri, version, list(_diagnostics(self._server, document, checked)))

    def _publish(self, uri: str, version: int | None, told: list[types.Diagnostic]) -> None:
        self._server.text_document_publish_diagnostics(
            types.PublishDiagnosticsParams(uri=uri, version=version, diagnostics=told)
        )


def make_server() -> LanguageServer:
    """The server, ready to be started."""
    server = LanguageServer(SOURCE, __version__)
    desks: list[_Desk] = []

    def desk() -> _Desk:
        if not desks:  # its lock belongs to the loop that serves
            desks.append(_Desk(server))
        return desks[0]

    @server.feature(types.TEXT_DOCUMENT_DID_OPEN)
    async def opened(params: types.DidOpenTextDocumentParams) -> None:
        desk().changed(params.text_document.uri, 0.0)

    @server.feature(types.TEXT_DOCUMENT_DID_CHANGE)
    async def changed(params: types.DidChangeTextDocumentParams) -> None:
        desk().changed(params.text_document.uri)

    @server.feature(types.TEXT_DOCUMENT_DID_SAVE)
    async def saved(params: types.DidSaveTextDocumentParams) -> None:
        desk().changed(params.text_document.uri, 0.0)

    @server.feature(types.TEXT_DOCUMENT_DID_CLOSE)
    async def closed(params: types.DidCloseTextDocumentParams) -> None:
        desk().closed(params.text_document.uri)

    @server.feature(
        types.TEXT_DOCUMENT_CODE_ACTION,
        types.CodeActionOptions(code_action_kinds=[types.CodeActionKind.QuickFix]),
    )
    async def quick_fixes(params: types.CodeActionParams) -> list[types.CodeAction]:
        document = server.workspace.get_text_document(params.text_document.uri)
        return [
            _action(server, document, mend, params.context.diagnostics)
            for mend in desk().mends(document)
            if _concerns(mend, params)
        ]

    return server


def _concerns(mend: Mend, params: types.CodeActionParams) -> bool:
    """Whether a mend is for one of the findings at the cursor."""
    codes = {str(one.code) for one in params.context.diagnostics if one.source == SOURCE}
    if codes:
        return bool(codes.intersection(mend.rules))
    first, last = params.range.start.line, params.range.end.line
    return mend.line is not None and first <= mend.line - 1 <= last


def _diagnostics(
    server: LanguageServer, document: TextDocument, checked: CheckedProtocol
) -> Iterator[types.Diagnostic]:
    severities = types.DiagnosticSeverity
    if checked.problem is not None:
        told = f"cannot be judged: {checked.problem.message}"
        yield _diagnostic(server, document, checked.problem.line, told)
    for finding in checked.findings:
        kind = severities.Error if finding.severity is Severity.ERROR else severities.Warning
        # The last line is where the harm was done.
        line = finding.lines[-1] if finding.lines else None
        told = f"{finding.message}\nFix: {finding.fix}" if finding.fix else finding.message
        yield _diagnostic(server, document, line, told, finding.rule, kind)
    for remark in checked.remarks:
        yield _diagnostic(server, document, remark.line, remark.message, None, severities.Warning)
    run = _line_of_run(document.source)
    for undecided in checked.undecided:
        told = f"undecided: {undecided.told}"
        yield _diagnostic(server, document, run, told, undecided.rule, severities.Information)


def _diagnostic(
    server: LanguageServer,
    document: TextDocument,
    line: int | None,
    message: str,
    code: str | None = None,
    severity: types.DiagnosticSeverity = types.DiagnosticSeverity.Error,
) -> types.Diagnostic:
    row = min(max((line or 1) - 1, 0), max(len(document.lines) - 1, 0))
    text = document.lines[row].rstrip("\r\n") if document.lines else ""
    start = len(text) - len(text.lstrip())
    return types.Diagnostic(
        range=_range(server, document, row, start, row, len(text)),
        message=message,
        severity=severity,
        code=code,
        source=SOURCE,
    )


def _action(
    server: LanguageServer, document: TextDocument, mend: Mend, told: Sequence[types.Diagnostic]
) -> types.CodeAction:
    edits = [_text_edit(server, document, edit) for edit in mend.edits]
    return types.CodeAction(
        title=mend.title,
        kind=types.CodeActionKind.QuickFix,
        diagnostics=[one for one in told if str(one.code) in mend.rules],
        edit=types.WorkspaceEdit(changes={document.uri: edits}),
        is_preferred=mend.sure,
    )


def _text_edit(server: LanguageServer, document: TextDocument, edit: Edit) -> types.TextEdit:
    start, end = (_place(document.source, offset) for offset in (edit.start, edit.end))
    return types.TextEdit(_range(server, document, *start, *end), edit.text)


def _place(text: str, offset: int) -> tuple[int, int]:
    """Row and column of an offset, both from 0."""
    before = text[:offset].splitlines(keepends=True)
    if not before or before[-1].endswith(("\n", "\r")):
        return len(before), 0
    return len(before) - 1, len(before[-1])


def _range(
    server: LanguageServer, document: TextDocument, row: int, column: int, to: int, end: int
) -> types.Range:
    """A range of characters, in the units that the client counts in."""
    found = types.Range(types.Position(row, column), types.Position(to, end))
    codec = server.workspace.position_codec
    return codec.range_to_client_units(document.lines, found)


def _line_of_run(text: str) -> int | None:
    lines = text.splitlines()
    return next((n for n, line in enumerate(lines, 1) if line.startswith("def run")), None)
