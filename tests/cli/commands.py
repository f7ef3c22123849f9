"""Runs the command line inside the test's process."""

from __future__ import annotations

import sys
from dataclasses import dataclass
from unittest import mock

import pytest

from aegis_ot.cli.app import run


@dataclass(frozen=True)
class Result:
    """What a command did."""

    code: int
    out: str
    err: str


class Command:
    """Calls ``aegis-ot`` with arguments."""

    def __init__(self, capfdbinary: pytest.CaptureFixture[bytes]) -> None:
        self._capture = capfdbinary

    def __call__(self, *arguments: object) -> Result:
        argv = ["aegis-ot", *map(str, arguments)]
        with mock.patch.object(sys, "argv", argv), pytest.raises(SystemExit) as ended:
            run()
        out, err = self._capture.readouterr()
        code = ended.value.code
        return Result(0 if code is None else int(code), out.decode(), err.decode())
