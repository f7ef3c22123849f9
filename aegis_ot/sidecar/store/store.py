"""The store as the sidecar holds it: one data folder with all of its tables and files."""

from __future__ import annotations

import contextlib
import sqlite3
from collections.abc import Iterator
from typing import Any

from .captures import Captures
from .chain import FRAMES
from .records import OF_A_RUN, Records
from .runs import Runs


class Store(Runs, Captures, Records):
    """One data folder: runs, their frames, and what came of them. Safe to use from threads.

    Args:
        folder: Made if it is missing.
        alone: See :class:`~.database.Database`.

    Raises:
        StoreError: From every method, if the disk or the database does not play along.
    """

    def size(self, run: str) -> int:
        """What a run's frames take on the disk, bytes."""
        with self._plain_errors("read from"):
            return self._frames.size(run)

    def forget(self, run: str, why: str = "retention") -> None:
        """Remove a run with its frames and all that is known of it. It cannot be brought back;
        the store's own chain keeps that it was removed, and why."""
        with self._transaction("write to"):
            self._chain.remove(run, why)
        with self._plain_errors("remove a run from"):
            self._frames.remove(run)
        with self._transaction("write to"):
            for table in (*OF_A_RUN, "chain", "seals", "runs"):
                self._db.execute(f"DELETE FROM {table} WHERE run = ?", (run,))
            self._chain.forget_touched()

    def chained(self, run: str) -> tuple[dict[int, str], dict[str, Any] | None]:
        """SHA-256 of frames by number, and the newest hash of the run's chain with its signature;
        nothing of an older run."""
        frames = self._read(
            "SELECT key, digest FROM chain WHERE run = ? AND kind = ? ORDER BY number", run, FRAMES
        )
        seal = self._read(
            "SELECT c.number, c.hash, s.key, s.signature FROM chain c JOIN seals s USING (run) "
            "WHERE run = ? ORDER BY number DESC LIMIT 1",
            run,
        )
        hashes = {int(row["key"]): row["digest"] for row in frames if row["digest"]}
        return hashes, dict(seal[0]) if seal else None

    @contextlib.contextmanager
    def snapshot(self) -> Iterator[sqlite3.Connection]:
        """Read at one moment, whatever is written meanwhile."""
        with self._transaction("read from", "BEGIN"):
            yield self._db
