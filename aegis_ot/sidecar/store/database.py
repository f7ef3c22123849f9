"""The SQLite file of a data folder: opened, checked, locked, and never half written."""

from __future__ import annotations

import contextlib
import json
import os
import sqlite3
import threading
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import IO, Any, TypeVar

from ...errors import StoreError
from .chain import Chain, File
from .frames import FRAMES
from .schema import migrate

T = TypeVar("T")

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
            self._refuse_emptied()
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

    def _refuse_emptied(self) -> None:
        """An empty file is no new store where one was: opening it would throw the log away, too.

        Raises:
            StoreError: The database has 0 bytes, and the folder holds what belongs to one.
        """
        path = self.folder / DATABASE
        if not path.is_file() or path.stat().st_size:
            return
        log, frames = path.with_name(f"{DATABASE}-wal"), self.folder / FRAMES
        kept = next(frames.iterdir(), None) if frames.is_dir() else None
        if kept is not None or (log.is_file() and log.stat().st_size):
            raise StoreError(
                f"The store {path} is empty (0 bytes), but there was one: frames or a log of it "
                "are in the folder. Nothing was changed. Restore it from a backup, or move it away "
                "to begin anew: the frames stay in their folder."
            )

    def _open(self, alone: bool) -> sqlite3.Connection:
        with self._plain_errors("open"):
            db = sqlite3.connect(
                self.folder / DATABASE, check_same_thread=False, isolation_level=None, timeout=5.0
            )
            # What rots is one row's, and not an error of the whole table.
            db.text_factory = lambda text: text.decode("utf-8", "replace")
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
                self._chain = Chain(db, self.folder)
                if alone:
                    self._chain.check_key()
            except BaseException:
                db.close()
                raise
        return db

    def _let_go(self) -> None:
        held, self._held = self._held, None
        if held is not None:
            held.close()

    def _write(
        self, statement: str, values: tuple[Any, ...], run: str = "", files: Iterable[File] = ()
    ) -> int:
        """Number of rows changed. They are chained, and so are files of a run."""
        with self._transaction("write to"):
            changed = self._db.execute(statement, values).rowcount if statement else 0
            self._chain.append(run, files)
            return changed

    @contextlib.contextmanager
    def _transaction(self, what: str, begin: str = "BEGIN IMMEDIATE") -> Iterator[None]:
        """Whole or not at all; nobody else reads or writes meanwhile. Raises StoreError."""
        with self._lock, self._plain_errors(what):
            self._db.execute(begin)
            try:
                yield
                self._db.execute("COMMIT")
            except BaseException:
                with contextlib.suppress(sqlite3.Error):
                    self._db.execute("ROLLBACK")
                raise

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
        except sqlite3.ProgrammingError as error:
            raise StoreError(
                f"Cannot {what} the store in {self.folder}: {str(error).rstrip('.')}. A sidecar "
                "that is being stopped closes it; nothing is damaged."
            ) from error
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
        if isinstance(error, FileExistsError | NotADirectoryError):
            return StoreError(f"Cannot {what} the store in {self.folder}: a file is in the way.")
        return StoreError(
            f"Cannot {what} the store in {self.folder}: {error}. "
            "Check free space and permissions there."
        )


def _close_to_strangers(folder: Path) -> None:
    """Frames and names are the laboratory's: take from other users of the machine what an older
    version gave them. The group's rights stay as somebody has set them."""
    with contextlib.suppress(PermissionError):  # somebody else's folder: the administrator's choice
        folder.chmod(folder.stat().st_mode & 0o770)


def readable(text: Any, kind: type[T]) -> T | None:
    """JSON of the store; ``None`` where one row's is damaged."""
    try:
        value = json.loads(text)
    except (TypeError, ValueError, RecursionError):
        return None
    return value if isinstance(value, kind) else None


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
