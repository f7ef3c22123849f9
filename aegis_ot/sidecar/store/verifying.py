"""Whether the record of a run is what its sidecar wrote, told from the data folder alone."""

from __future__ import annotations

import itertools
import sqlite3
from collections.abc import Collection, Iterator, Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, Literal

from .chain import BEGUN, CLIPS, FRAMES, KEYS, LEDGER, REMOVED, digest_of, key_of, link, sealed
from .signing import is_signed
from .store import Store

State = Literal["sound", "tampered", "unchained", "removed"]
_WORDS = {
    "runs": "the run's own row", "keyframes": "keyframe", "verdicts": "verdict of delivery",
    "abandoned": "given-up delivery", "holds": "hold", "decisions": "decision", "actions": "answer",
    "incidents": "incident", "recoveries": "recovery", "audits": "the look back",
    FRAMES: "frame", CLIPS: "clip of delivery", BEGUN: "run", REMOVED: "removal of run",
}  # fmt: skip
Digests = dict[tuple[str, str], str | None]


@dataclass(frozen=True)
class Tampering:
    """Something that is not as it was written.

    Attributes:
        what: ``"changed"``, ``"added"``, ``"removed"``, ``"reordered"``, ``"broken"`` (the chain
            itself) or ``"signature"``.
        where: The record or entry, in words.
    """

    what: str
    where: str


@dataclass(frozen=True)
class VerifiedRun:
    """What a chain says of one run.

    Attributes:
        run: Its name; ``""`` is the store's own list of runs.
        state: ``unchained``: kept by a version without chains, so nothing can be said.
        entries: How many records were chained.
        head: Hash of the newest entry: who notes it elsewhere can tell later that none was lost.
        key: Public key that signed it, hexadecimal.
        closed: Whether the run has ended.
        found: What is not as it was written.
        notes: What else should be known.
    """

    run: str
    state: State
    entries: int = 0
    head: str = ""
    key: str = ""
    closed: bool = False
    found: tuple[Tampering, ...] = ()
    notes: tuple[str, ...] = ()


@dataclass
class _Chain:
    """A chain that was read again."""

    entries: int = 0
    head: str = ""
    key: str = ""
    last: Digests = field(default_factory=dict)
    order: dict[tuple[str, str], int] = field(default_factory=dict)
    found: list[Tampering] = field(default_factory=list)


def verify_runs(
    store: Store, known_keys: Collection[str], runs: Collection[str] = ()
) -> list[VerifiedRun]:
    """Hold the records of runs against their chains. Nothing is written.

    Args:
        store: An open store; a sidecar may be at work on it.
        known_keys: Public keys that may have signed, hexadecimal.
        runs: Which; all, removed ones too, if none is named.

    Returns:
        The store's own list of runs first, under the name ``""``, then each run.

    Raises:
        StoreError: The store cannot be read.
    """
    files = {run: store.files_of(run) for run in runs or [row["run"] for row in store.runs()]}
    with store.snapshot() as db:
        ledger = _read_chain(db, LEDGER, known_keys)
        begun = {key for kind, key in ledger.last if kind == BEGUN}
        rows = [run for (run,) in db.execute("SELECT run FROM runs ORDER BY rowid")]
        chained = {run for (run,) in db.execute("SELECT DISTINCT run FROM chain")} - {LEDGER}
        first = next((rows.index(run) for run in rows if run in begun), len(rows))
        own = _list_of_runs(ledger, set(rows[first:]) | chained, rows)
        wanted = list(runs) or [*rows, *sorted((begun | chained) - set(rows), key=str)]
        found = [own] if ledger.entries or chained else []
        for run in wanted:
            gone = _was_removed(ledger, run)
            if run in begun | chained and (run in rows or gone is None):
                kept = files.get(run) or {}
                found.append(_verify(store, db, run, known_keys, kept, gone))
            elif gone is not None:
                found.append(VerifiedRun(run, "removed", notes=(f"removed by {gone}",)))
            elif run in rows[first:]:
                lost = Tampering("removed", "the whole chain")
                found.append(VerifiedRun(run, "tampered", found=(lost,)))
            else:
                found.append(VerifiedRun(run, "unchained"))
    return found


def _list_of_runs(ledger: _Chain, expected: Collection[str], rows: Collection[str]) -> VerifiedRun:
    """The store's own chain: whether a whole run was added or lost."""
    begun = {key for kind, key in ledger.last if kind == BEGUN}
    lost = [run for run in begun if run not in rows and _was_removed(ledger, run) is None]
    found = [
        *ledger.found,
        *(Tampering("removed", f"the run {run!r}") for run in sorted(lost, key=str)),
        *(Tampering("added", f"the run {run!r}") for run in sorted(set(expected) - begun, key=str)),
    ]
    state: State = "tampered" if found else "sound"
    return VerifiedRun(LEDGER, state, ledger.entries, ledger.head, ledger.key, found=tuple(found))


def _was_removed(ledger: _Chain, run: str) -> str | None:
    """Why a run was removed after it last began; ``None`` if it was not."""
    removed = ledger.order.get((REMOVED, run), -1)
    if removed < ledger.order.get((BEGUN, run), 0):
        return None
    return str(ledger.last[REMOVED, run])


def _verify(
    store: Store,
    db: sqlite3.Connection,
    run: str,
    known_keys: Collection[str],
    files: Mapping[tuple[str, str], Path],
    gone: str | None,
) -> VerifiedRun:
    chain = _read_chain(db, run, known_keys)
    if not chain.entries:
        chain.found.append(Tampering("removed", "the whole chain"))
    now: Digests = {}
    for table in KEYS:
        for row in _rows(db, f"SELECT * FROM {table} WHERE run = ?", run):
            now[table, key_of(table, row)] = digest_of(table, row)
    notes = []
    if gone is None:
        for name, path in files.items():
            if (digest := store.file_digest(path)) is not None:
                now[name] = digest
        # A sidecar that is at work wrote these between the listing of files and the snapshot.
        for kind, key in chain.last.keys() - now.keys():
            if kind in (FRAMES, CLIPS) and key.isdecimal():
                path = store.file_of(run, kind, int(key))
                if (digest := store.file_digest(path)) is not None:
                    now[kind, key] = digest
    else:
        notes.append(f"it is being removed by {gone}: its frames are not looked at")
        chain.last = {name: d for name, d in chain.last.items() if name[0] not in (FRAMES, CLIPS)}
    sequences = [int(key) for kind, key in now if kind == "keyframes" and key.isdigit()]
    # A frame is written before its row, and a power cut may take several of the last rows.
    coming = max(sequences, default=-1) + 1
    after = itertools.takewhile(
        now.__contains__, ((FRAMES, str(n)) for n in itertools.count(coming))
    )
    clips = (name for name in now if name[0] == CLIPS)
    for name in [n for n in (*after, *clips) if n not in chain.last]:
        notes.append(f"{_WORDS[name[0]]} {name[1]} is no part of the record: no entry names it")
        del now[name]
    found = (*chain.found, *_differences(chain.last, now))
    ended = db.execute("SELECT finished FROM runs WHERE run = ?", (run,)).fetchone()
    return VerifiedRun(
        run,
        "tampered" if found else "sound",
        chain.entries,
        chain.head,
        chain.key,
        bool(ended and ended[0]),
        found,
        tuple(notes),
    )


def _differences(before: Digests, now: Digests) -> Iterator[Tampering]:
    """What the chain names and the store holds, held against each other."""
    gone = object()
    other = [n for n, digest in before.items() if now.get(n) != digest]
    for kind in dict.fromkeys(name[0] for name in other):
        mine = [name for name in other if name[0] == kind]
        swapped = len(mine) > 1 and sorted(str(before[n]) for n in mine) == sorted(
            str(now.get(n, gone)) for n in mine
        )
        for name in mine:
            what = "changed" if name in now and before[name] is not None else "removed"
            if before[name] is None:  # a power cut had torn it; its frame may lie there still
                if kind == FRAMES:
                    continue
                what = "added"
            yield Tampering("reordered" if swapped else what, _place(name))
    for name in now.keys() - before.keys():
        yield Tampering("added", _place(name))


def _place(name: tuple[str, str]) -> str:
    return f"{_WORDS.get(name[0], name[0])} {name[1]}".rstrip()


def _read_chain(db: sqlite3.Connection, run: str, known_keys: Collection[str]) -> _Chain:
    """Follow a chain from its beginning, and hold its end against the signature."""
    chain = _Chain()
    last_number = -1
    for entry in _rows(db, "SELECT * FROM chain WHERE run = ? ORDER BY number", run):
        name = entry["kind"], entry["key"]
        where = f"entry {entry['number']} of the chain ({_place(name)})"
        if entry["number"] != chain.entries:
            chain.found.append(Tampering("removed", f"an entry of the chain before {where}"))
            chain.entries = entry["number"] if isinstance(entry["number"], int) else chain.entries
        if entry["hash"] != link(chain.head, entry):
            chain.found.append(Tampering("broken", where))
        chain.head, last_number = entry["hash"], entry["number"]
        chain.last[name], chain.order[name] = entry["digest"], chain.entries
        chain.entries += 1
    seal = next(_rows(db, "SELECT * FROM seals WHERE run = ?", run), None)
    if seal is None:
        if chain.entries:
            chain.found.append(Tampering("signature", "it is missing"))
        return chain
    chain.key = seal["key"]
    if not is_signed(seal["key"], seal["signature"], sealed(run, last_number, chain.head)):
        why = "it does not fit the end of the chain: the chain, its last records or it were changed"
        chain.found.append(Tampering("signature", why))
    elif chain.key not in known_keys:
        why = (
            f"it is of the key {chain.key}, which this folder does not hold (--key vouches for it)"
        )
        chain.found.append(Tampering("signature", why))
    return chain


def _rows(db: sqlite3.Connection, statement: str, run: str) -> Iterator[dict[str, Any]]:
    cursor = db.execute(statement, (run,))
    names = [column[0] for column in cursor.description]
    for row in cursor:
        yield dict(zip(names, row, strict=True))
