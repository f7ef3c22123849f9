"""The hash chain of each run: every record that is written leaves an entry that names its hash.

An entry's hash covers the one before it (SHA-256 over canonical JSON), and the sidecar's key signs
the newest. Who changes, adds, removes or reorders a record afterwards breaks one of both.
"""

from __future__ import annotations

import hashlib
import json
import sqlite3
import time
from collections.abc import Iterable, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import Any

from ...errors import StoreError
from .signing import Signer

KEYS: dict[str, tuple[str, ...]] = {
    "runs": (),
    "keyframes": ("sequence",),
    "verdicts": ("trajectory",),
    "abandoned": ("trajectory",),
    "holds": ("trajectory", "number"),
    "decisions": ("id",),
    "actions": ("id",),
    "incidents": ("id",),
    "recoveries": ("trajectory", "attempt"),
    "audits": (),
}
"""Tables that are chained, and what names a row in its run."""
MEANINGLESS = ("heard",)
"""Columns that no record depends on: by them the sidecar counts its own time."""
FRAMES, CLIPS = "frames", "clips"
BEGUN, REMOVED = "begun", "removed"
LEDGER = ""
"""The chain of the store itself, under the name that no run has: which runs there were."""

File = tuple[str, str, str]
"""A file that belongs to a record: ``"frames"`` or ``"clips"``, its number, its SHA-256."""


def canonical(value: Any) -> bytes:
    """JSON that is the same for the same value, everywhere."""
    return json.dumps(value, sort_keys=True, separators=(",", ":"), default=bytes.hex).encode()


def sha256(data: bytes) -> str:
    """Hexadecimal."""
    return hashlib.sha256(data).hexdigest()


def digest_of(table: str, row: Mapping[str, Any]) -> str:
    """The hash of a row's content. What names the row stands in the entry beside it; an empty
    cell counts as none, so that a newer version may add columns."""
    left_out = ("run", *KEYS[table], *MEANINGLESS)
    return sha256(canonical({k: v for k, v in row.items() if k not in left_out and v is not None}))


def key_of(table: str, row: Mapping[str, Any]) -> str:
    """What names a row in its run: ``"12"``, ``"3/0"``."""
    return "/".join(str(row[column]) for column in KEYS[table])


def link(previous: str, entry: Mapping[str, Any]) -> str:
    """The hash of an entry that follows another."""
    names = ("run", "number", "kind", "key", "digest", "at")
    return sha256(canonical([previous, *(entry[name] for name in names)]))


def sealed(run: str, number: int, head: str) -> bytes:
    """What is signed of a chain: its name, the number and the hash of its newest entry."""
    return canonical(["aegis-ot record", run, number, head])


class Chain:
    """Follows every write of one connection, and chains it in the same transaction.

    Args:
        db: An open store; its temporary triggers see what is written, and not what others write.
        folder: Holds the key.
    """

    def __init__(self, db: sqlite3.Connection, folder: Path) -> None:
        self._db, self._folder = db, folder
        self._signer: Signer | None = None
        db.execute("PRAGMA temp_store = MEMORY")  # a full disk has no room for it
        db.execute("CREATE TEMP TABLE touched (op TEXT, kind TEXT, run TEXT, key TEXT)")
        for table, columns in KEYS.items():
            for op, row in (("INSERT", "NEW"), ("UPDATE", "NEW"), ("DELETE", "OLD")):
                key = " || '/' || ".join(f"{row}.{column}" for column in columns) or "''"
                db.execute(
                    f"CREATE TEMP TRIGGER {table}_{op} AFTER {op} ON main.{table} BEGIN "
                    f"INSERT INTO touched VALUES ('{op}', '{table}', {row}.run, {key}); END"
                )

    def check_key(self) -> None:
        """Read the key now, or make it, and not in the middle of a run. Raises StoreError."""
        if find_spec("cryptography") is None:
            raise StoreError(
                "The sidecar signs its records with the package cryptography, which is not "
                "installed: pip install 'aegis-ot[sidecar]'."
            )
        self._signer = Signer(self._folder)

    def append(self, run: str = "", files: Iterable[File] = ()) -> None:
        """Chain what was written since the last call, and files of ``run``.

        Raises:
            StoreError: There is no key, and none can be made.
        """
        touched = self._db.execute("SELECT * FROM touched").fetchall()
        self.forget_touched()
        heads: dict[str, tuple[int, str]] = {}
        for kind, key, digest in files:
            self._add(heads, run, kind, key, digest)
        for op, kind, of, key in touched:
            if kind == "runs" and op == "INSERT":
                self._add(heads, LEDGER, BEGUN, of, "")
                heads.setdefault(of, (-1, ""))
            self._add(heads, of, kind, key, self._digest(kind, of, key))
            if kind == "keyframes" and op == "DELETE":
                self._add(heads, of, FRAMES, key, None)
        for of, (number, head) in heads.items():
            if number >= 0:
                self._sign(of, number, head)

    def remove(self, run: str, why: str) -> None:
        """Chain that a run is being removed, if it has a chain. Raises StoreError."""
        if self._head(run) is not None:
            heads: dict[str, tuple[int, str]] = {}
            self._add(heads, LEDGER, REMOVED, run, why)
            self._sign(LEDGER, *heads[LEDGER])

    def forget_touched(self) -> None:
        """What was written since the last call needs no entry."""
        self._db.execute("DELETE FROM touched")

    def _digest(self, table: str, run: str, key: str) -> str | None:
        """Of a row as it stands now; ``None`` if it is gone."""
        columns = KEYS[table]
        where = " AND ".join(("run = ?", *(f"{column} = ?" for column in columns)))
        values = [int(part) for part in key.split("/")] if columns else []
        cursor = self._db.execute(f"SELECT * FROM {table} WHERE {where}", (run, *values))
        row = cursor.fetchone()
        names = [column[0] for column in cursor.description]
        return None if row is None else digest_of(table, dict(zip(names, row, strict=True)))

    def _head(self, run: str) -> tuple[int, str] | None:
        found: tuple[int, str] | None = self._db.execute(
            "SELECT number, hash FROM chain WHERE run = ? ORDER BY number DESC LIMIT 1", (run,)
        ).fetchone()
        return found

    def _add(
        self, heads: dict[str, tuple[int, str]], run: str, kind: str, key: str, digest: str | None
    ) -> None:
        head = heads.get(run) or self._head(run)
        if head is None:
            if run != LEDGER:
                return  # an older run, without a chain
            head = -1, ""
        known = self._db.execute(
            "SELECT digest FROM chain WHERE run = ? AND kind = ? AND key = ? "
            "ORDER BY number DESC LIMIT 1",
            (run, kind, key),
        ).fetchone()
        if run != LEDGER and known is not None and known[0] == digest:
            return  # nothing that means something was changed
        entry = {
            "run": run, "number": head[0] + 1, "kind": kind, "key": key, "digest": digest,
            "at": time.time(),
        }  # fmt: skip
        newest = link(head[1], entry)
        self._db.execute(
            "INSERT INTO chain VALUES (?, ?, ?, ?, ?, ?, ?)", (*entry.values(), newest)
        )
        heads[run] = head[0] + 1, newest

    def _sign(self, run: str, number: int, head: str) -> None:
        if self._signer is None:
            self._signer = Signer(self._folder)
        signature = self._signer.sign(sealed(run, number, head))
        self._db.execute(
            "INSERT OR REPLACE INTO seals VALUES (?, ?, ?)", (run, self._signer.public, signature)
        )
