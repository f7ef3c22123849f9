"""A store whose live cascade passed a fault in silence."""

from __future__ import annotations

import shutil
from collections.abc import Callable
from pathlib import Path

import pytest

from aegis_ot.sidecar.store import Store
from tests.worldmodel.stores import make_store

STRUCK = 2
"""The third well got nothing: one of those on which the run is calibrated."""


def pass_silently(store: Store, trajectory: int) -> None:
    """As if the live cascade had found nothing."""
    store._write(
        "UPDATE verdicts SET verdict = json_set(verdict, '$.outcome', 'pass', '$.route', "
        "'silent_pass', '$.gate', 'none', '$.failure', null, '$.reason', 'Inside the band.') "
        "WHERE trajectory = ?",
        (trajectory,),
    )


@pytest.fixture(scope="module")
def passed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Eight wells of a dye; the third was not dispensed into, and passed."""
    faults = tuple("no_dispense" if n == STRUCK else "" for n in range(8))
    folder = make_store(tmp_path_factory.mktemp("passed") / "store", faults)
    store = Store(folder)
    for trajectory in range(8):
        pass_silently(store, trajectory)
    store.close()
    return folder


@pytest.fixture
def copied(passed: Path, tmp_path: Path) -> Callable[[], Store]:
    """A copy of it to spoil."""

    def copy() -> Store:
        shutil.copytree(passed, tmp_path / "copy")
        return Store(tmp_path / "copy")

    return copy
