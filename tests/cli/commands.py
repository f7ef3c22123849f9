"""Runs the command line inside the test's process."""

from __future__ import annotations

import logging
import sys
from collections.abc import Iterator
from contextlib import contextmanager
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
        with (
            _log_as_before(),
            mock.patch.object(sys, "argv", argv),
            pytest.raises(SystemExit) as ended,
        ):
            run()
        out, err = self._capture.readouterr()
        code = ended.value.code
        return Result(0 if code is None else int(code), out.decode(), err.decode())


@contextmanager
def _log_as_before() -> Iterator[None]:
    """A sidecar's command logs to the standard error of its test, which is closed afterwards."""
    logger = logging.getLogger("aegis_ot")
    kept = logger.handlers[:], logger.level, logger.propagate
    try:
        yield
    finally:
        logger.handlers[:], logger.level, logger.propagate = kept
