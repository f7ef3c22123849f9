"""What holds for all tests."""

from __future__ import annotations

import atexit
import os
import shutil
import tempfile
from typing import Any

import pytest

_OWN = "AEGIS_OT_TESTS_RUNTIME_DIR"


def _share_rehearsing_processes() -> None:
    """One warm rehearsing process serves the whole session, as it serves a user's second command.

    It listens in a folder of this session's own, so that no other session's is found, and ends
    with it. The folder lies high up: a socket's path is short.
    """
    if _OWN not in os.environ:  # pytest-xdist's workers get it from the process that starts them
        os.environ[_OWN] = tempfile.mkdtemp(prefix="aegis-")
        atexit.register(shutil.rmtree, os.environ[_OWN], ignore_errors=True)
    os.environ["XDG_RUNTIME_DIR"] = os.environ[_OWN]
    os.environ["AEGIS_OT_WARM"] = "120"


_share_rehearsing_processes()


LONGEST = (
    "tests/compat/test_matrix.py",
    "tests/compat/test_extras.py",
    "tests/cli/test_demo.py",
    "tests/docs/",
    "tests/lab/",
    "tests/robot/",
    "tests/rules/",
    "tests/workbench/",
)
"""What takes longest begins first, in this order: no process ends long before the others."""
APART = "tests/compat/test_matrix.py"
"""Its tests take a minute each and share nothing: each may go to another process."""


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    def place(item: pytest.Item) -> int:
        found = (n for n, start in enumerate(LONGEST) if item.nodeid.startswith(start))
        return next(found, len(LONGEST))

    items.sort(key=place)


@pytest.hookimpl(optionalhook=True)
def pytest_xdist_make_scheduler(config: pytest.Config, log: Any) -> Any:
    """File by file, in the order above."""
    from xdist.scheduler import LoadFileScheduling

    class Scheduling(LoadFileScheduling):
        def _split_scope(self, nodeid: str) -> str:
            return nodeid if nodeid.startswith(APART) else super()._split_scope(nodeid)

    return Scheduling(config, log) if config.option.dist == "loadfile" else None
