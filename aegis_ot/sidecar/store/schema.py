"""The store's tables, and how an older store becomes a newer one."""

from __future__ import annotations

import sqlite3

from ...errors import StoreError

MIGRATIONS: tuple[str, ...] = (
    """
    CREATE TABLE runs (
        run TEXT PRIMARY KEY, folder TEXT NOT NULL UNIQUE, start TEXT NOT NULL,
        registered REAL NOT NULL, finished REAL, outcome TEXT, detail TEXT
    );
    CREATE TABLE keyframes (
        run TEXT NOT NULL REFERENCES runs, sequence INTEGER NOT NULL,
        trajectory INTEGER NOT NULL, keyframe TEXT NOT NULL,
        exposed_after_s REAL NOT NULL, captured REAL NOT NULL,
        PRIMARY KEY (run, sequence)
    );
    CREATE TABLE verdicts (
        run TEXT NOT NULL REFERENCES runs, trajectory INTEGER NOT NULL,
        verdict TEXT NOT NULL, evidence TEXT NOT NULL, judged REAL NOT NULL,
        PRIMARY KEY (run, trajectory)
    );
    CREATE TABLE abandoned (
        run TEXT NOT NULL REFERENCES runs, trajectory INTEGER NOT NULL,
        reason TEXT NOT NULL, at REAL NOT NULL,
        PRIMARY KEY (run, trajectory)
    );
    CREATE TABLE holds (
        run TEXT NOT NULL REFERENCES runs, trajectory INTEGER NOT NULL,
        seconds REAL NOT NULL, resolution TEXT NOT NULL, policy TEXT, at REAL NOT NULL,
        PRIMARY KEY (run, trajectory)
    );
    CREATE TABLE decisions (
        id INTEGER PRIMARY KEY, run TEXT NOT NULL REFERENCES runs, trajectory INTEGER NOT NULL,
        outcome TEXT NOT NULL, "by" TEXT NOT NULL, note TEXT NOT NULL, at REAL NOT NULL
    );
    CREATE INDEX decisions_of ON decisions (run, trajectory);
    """,
    """
    ALTER TABLE runs ADD COLUMN sidecar TEXT;
    ALTER TABLE holds ADD COLUMN paused_s REAL;
    ALTER TABLE holds ADD COLUMN answered TEXT;
    CREATE TABLE actions (
        id INTEGER PRIMARY KEY, run TEXT NOT NULL REFERENCES runs, trajectory INTEGER NOT NULL,
        action TEXT NOT NULL, "by" TEXT NOT NULL, note TEXT NOT NULL, at REAL NOT NULL
    );
    CREATE INDEX actions_of ON actions (run);
    CREATE TABLE incidents (
        id INTEGER PRIMARY KEY, run TEXT NOT NULL REFERENCES runs, kind TEXT NOT NULL,
        text TEXT NOT NULL, at REAL NOT NULL, ended REAL
    );
    CREATE INDEX incidents_of ON incidents (run, kind);
    CREATE INDEX keyframes_of ON keyframes (run, captured);
    """,
    """
    CREATE TABLE recoveries (
        run TEXT NOT NULL REFERENCES runs, trajectory INTEGER NOT NULL, attempt INTEGER NOT NULL,
        action TEXT NOT NULL, state TEXT NOT NULL, "by" INTEGER, text TEXT NOT NULL,
        at REAL NOT NULL, PRIMARY KEY (run, trajectory, attempt)
    );
    """,
    """
    CREATE TABLE audits (
        run TEXT PRIMARY KEY REFERENCES runs, audit TEXT NOT NULL, at REAL NOT NULL
    );
    """,
    # A delivery can be held for more than once: a person pauses the run, then its verdict is bad.
    """
    ALTER TABLE holds RENAME TO one_hold_each;
    CREATE TABLE holds (
        run TEXT NOT NULL REFERENCES runs, number INTEGER NOT NULL, trajectory INTEGER NOT NULL,
        seconds REAL NOT NULL, resolution TEXT NOT NULL, policy TEXT, paused_s REAL, answered TEXT,
        at REAL NOT NULL, PRIMARY KEY (run, trajectory, number)
    );
    INSERT INTO holds SELECT run, 0, trajectory, seconds, resolution, policy, paused_s,
        answered, at FROM one_hold_each;
    DROP TABLE one_hold_each;
    """,
    # Ages are counted in the sidecar's own time at work: a clock that is set removes nothing.
    """
    CREATE TABLE at_work (seconds REAL NOT NULL);
    INSERT INTO at_work VALUES (0.0);
    ALTER TABLE runs ADD COLUMN heard REAL NOT NULL DEFAULT 0.0;
    """,
    """
    ALTER TABLE holds ADD COLUMN next TEXT NOT NULL DEFAULT '';
    """,
    # What is added to a chained table from here on may be empty, and is in older runs: a cell that
    # a migration fills would look like a change (see chain.digest_of).
    """
    CREATE TABLE chain (
        run TEXT NOT NULL, number INTEGER NOT NULL, kind TEXT NOT NULL, key TEXT NOT NULL,
        digest TEXT, at REAL NOT NULL, hash TEXT NOT NULL, PRIMARY KEY (run, number)
    );
    CREATE INDEX chain_of ON chain (run, kind, key, number);
    CREATE TABLE seals (run TEXT PRIMARY KEY, key TEXT NOT NULL, signature TEXT NOT NULL);
    """,
    """
    ALTER TABLE runs ADD COLUMN trajectories INTEGER;
    ALTER TABLE runs ADD COLUMN keyframes INTEGER;
    """,
)
"""One script per version, ``user_version`` counting those done. Only ever append."""


def migrate(connection: sqlite3.Connection) -> None:
    """Bring the database to the newest version, each step whole or not at all.

    Raises:
        StoreError: If a newer sidecar wrote it.
    """
    (version,) = connection.execute("PRAGMA user_version").fetchone()
    if version > len(MIGRATIONS):
        raise StoreError(
            f"The store was written by a newer sidecar (version {version}, this one knows "
            f"{len(MIGRATIONS)}). Update aegis-ot, or name another data folder."
        )
    for number in range(version, len(MIGRATIONS)):
        # executescript commits what stands before it, so the transaction is part of the script.
        connection.executescript(
            f"BEGIN IMMEDIATE;\n{MIGRATIONS[number]}\nPRAGMA user_version = {number + 1};\nCOMMIT;"
        )
