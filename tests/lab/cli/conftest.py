"""The command line, as in the tests of the other commands."""

from __future__ import annotations

from tests.cli.conftest import aegis

__all__ = ["aegis"]
