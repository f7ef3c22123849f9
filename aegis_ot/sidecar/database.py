"""The SQLite file of a data folder: opened, checked, locked, and never half written."""

from __future__ import annotations

import contextlib
import os
import sqlite3
import threading
from collections.abc import Iterator
from pathlib import Path
from typing import IO, Any

from ..errors import StoreError
from .schema import migrate

DATABASE = "sidecar.sqlite"
LOCK = "sidecar.lock"


class Database:
    """One data folder's database. Safe to use from several threads.

    Args:
        folder: Made if it is missing.
        alone: Whether this process is the folder's only writer: a second one is refused, and the
            database is checked before it is used. Readers leave it out.

    Raises:
        StoreError: From every method, if the disk or the database does not play along.
    """

    def __init__(self, folder: Path, alone: bool = False) -> None:
        self.folder = folder
        self._lock = threading.Lock()
        self._held: IO[str] | None = None
        with self._plain_errors("open"):
            folder.mkdir(0o700, parents=True, exist_ok=True)
            if alone:
                _close_to_strangers(folder)
                self._held = _hold(folder)
        try:
            self._db = self._open(alone)
        except BaseException:
            self._let_go()
            raise

    def close(self) -> None:
        """Close the database. Idempotent."""
        with self._lock, contextlib.suppress(sqlite3.Error):
            self._db.close()
        self._let_go()

    def _open(self, alone: bool) -> sqlite3.Connection:
        with self._plain_errors("open"):
            db = sqlite3.connect(
                self.folder / DATABASE, check_same_thread=False, isolation_level=None, timeout=5.0
            )
            try:
                db.execute("PRAGMA journal_mode = WAL")
                # With the write-ahead log the database stays whole in a power cut.
                db.execute("PRAGMA synchronous = NORMAL")
                db.execute("PRAGMA foreign_keys = ON")
                if alone:
                    (said,) = db.execute("PRAGMA quick_check(1)").fetchone()
                    if said != "ok":
                        raise sqlite3.DatabaseError(str(said).splitlines()[-1])
                migrate(db)
            except BaseException:
                db.close()
                raise
        return db

    def _let_go(self) -> None:
        held, self._held = self._held, None
        if held is not None:
            held.close()

    def _write(self, statement: str, values: tuple[Any, ...]) -> int:
        """Number of rows changed."""
        with self._lock, self._plain_errors("write to"):
            return self._db.execute(statement, values).rowcount

    def _read(self, statement: str, *values: Any) -> list[sqlite3.Row]:
        with self._lock, self._plain_errors("read from"):
            cursor = self._db.cursor()
            cursor.row_factory = sqlite3.Row
            return cursor.execute(statement, values).fetchall()

    @contextlib.contextmanager
    def _plain_errors(self, what: str) -> Iterator[None]:
        try:
            yield
        except sqlite3.OperationalError as error:  # busy, full, read-only: not the file's fault
            raise self._trouble(what, error) from error
        except sqlite3.DatabaseError as error:
            raise StoreError(
                f"The store {self.folder / DATABASE} is damaged: {error}. Nothing was changed. "
                "Restore it from a backup, save what can be saved (sqlite3 "
                f'{DATABASE} ".recover" | sqlite3 mended.sqlite), or move it away to begin '
                "anew: the frames stay in their folder."
            ) from error
        except OSError as error:
            raise self._trouble(what, error) from error

    def _trouble(self, what: str, error: Exception) -> StoreError:
        return StoreError(
            f"Cannot {what} the store in {self.folder}: {error}. "
            "Check free space and permissions there."
        )


def _close_to_strangers(folder: Path) -> None:
    """Frames and names are the laboratory's: take from other users of the machine what an older
    version gave them. The group's rights stay as somebody has set them."""
    with contextlib.suppress(PermissionError):  # somebody else's folder: the administrator's choice
        folder.chmod(folder.stat().st_mode & 0o770)


def _hold(folder: Path) -> IO[str]:
    """Lock the folder for this process; the system lets go when the process ends, however.

    Raises:
        StoreError: Another process has it.
    """
    file = (folder / LOCK).open("a+", encoding="ascii")
    try:
        _lock(file)
    except OSError:
        file.seek(0)
        who = file.read(20).strip()
        file.close()
        raise StoreError(
            f"Another sidecar{f' (process {who})' if who else ''} uses the data folder {folder}. "
            "Stop it, or name another folder (--data)."
        ) from None
    file.truncate(0)
    file.write(f"{os.getpid()}\n")
    file.flush()
    return file


def _lock(file: IO[str]) -> None:
    try:
        import fcntl
    except ImportError:  # Windows
        import msvcrt

        msvcrt.locking(file.fileno(), msvcrt.LK_NBLCK, 1)  # type: ignore[attr-defined,unused-ignore]
    else:
        fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
