"""A model's opinions, asked for once per digest and remembered: the sidecar's half of Layer 1.

Analysis asks while the scientist looks at the App; the live run of the same protocol finds the
answer waiting. What a model said is kept; an outage is not, and is asked about again. So is what
another model said, or this one to other rules or another prompt, before a restart.
"""

from __future__ import annotations

import hashlib
import json
import logging
import os
import tempfile
import threading
from pathlib import Path

from ..preflight import RuleSet, load_rules
from ..vocabulary import Dossier, Opinion, from_json, to_json
from .backend import Backend, State
from .hybrid import give_opinion
from .layer1_prompt import hybrid_request

MOST_PENDING = 8
"""Questions asked at once; more are told to come back."""

_LASTING = {State.ANSWERED.value, State.REFUSED.value, State.TRUNCATED.value, State.INVALID.value}
"""Not asked about again while the sidecar runs: the model itself said it."""

_KEPT = {State.ANSWERED.value, State.REFUSED.value}
"""Nor after a restart."""

_log = logging.getLogger(__name__)


class Opinions:
    """Asks, remembers, and lets callers wait as long as they like and no longer.

    Args:
        backend: Whom to ask; ``None``: every opinion is ``no_model``.
        folder: Where to keep opinions over restarts; ``None``: in memory only.
        rule_set: The rules; the shipped ones if left out.
    """

    def __init__(
        self, backend: Backend | None, folder: Path | None = None, rule_set: RuleSet | None = None
    ) -> None:
        self._backend = backend
        self._folder = folder
        self._rule_set = rule_set
        self._changed = threading.Condition()
        self._known: dict[str, Opinion] = {}
        self._pending: set[str] = set()

    def ask(self, dossier: Dossier) -> str:
        """See to it that this dossier has, or will have, an opinion; returns its digest."""
        digest = dossier.digest
        with self._changed:
            known = self._known.get(digest) or self._from_disk(dossier)
            if known is not None and known.state in _LASTING:
                self._known[digest] = known
                return digest
            if digest in self._pending:
                return digest
            self._known.pop(digest, None)
            if self._backend is None:
                detail = "The sidecar has no model; set AEGIS_OT_MODEL for it."
                self._known[digest] = Opinion(State.NO_MODEL.value, "no model", detail)
                return digest
            if len(self._pending) >= MOST_PENDING:
                detail = f"{MOST_PENDING} other questions are being answered."
                self._known[digest] = Opinion(State.RATE_LIMITED.value, self._backend.name, detail)
                return digest
            self._pending.add(digest)
        threading.Thread(
            target=self._work, args=(digest, dossier), name="aegis-ot-opinion", daemon=True
        ).start()
        return digest

    def wait(self, digest: str, seconds: float) -> Opinion | None:
        """The opinion, or ``None`` if it is not in after ``seconds``."""
        with self._changed:
            self._changed.wait_for(lambda: digest not in self._pending, seconds)
            if digest in self._pending:
                return None
            return self._known.get(digest)

    def knows(self, digest: str) -> bool:
        """Whether this digest was ever asked about, and is pending or answered."""
        with self._changed:
            return digest in self._pending or digest in self._known

    def _work(self, digest: str, dossier: Dossier) -> None:
        name = self._backend.name if self._backend is not None else "no model"
        try:
            opinion = give_opinion(dossier, self._rules(), self._backend)
        except Exception as error:  # a question must never stay pending for ever
            _log.exception("An opinion could not be had")
            detail = f"The sidecar failed ({type(error).__name__}); its log says more."
            opinion = Opinion(State.UNAVAILABLE.value, name, detail)
        if opinion.state in _KEPT:
            self._to_disk(dossier, opinion)
        with self._changed:
            self._known[digest] = opinion
            self._pending.discard(digest)
            self._changed.notify_all()

    def _rules(self) -> RuleSet:
        if self._rule_set is None:
            self._rule_set = load_rules()
        return self._rule_set

    def _place(self, dossier: Dossier) -> Path | None:
        """Where its opinion is kept; another model or another question has another place."""
        if self._folder is None or self._backend is None:
            return None
        asked = f"{self._backend.name} {hybrid_request(dossier, self._rules()).hash}"
        mark = hashlib.sha256(asked.encode("utf-8", "surrogatepass")).hexdigest()[:16]
        return self._folder / f"{dossier.digest}-{mark}.json"

    def _from_disk(self, dossier: Dossier) -> Opinion | None:
        path = self._place(dossier)
        if path is None:
            return None
        try:
            return from_json(Opinion, json.loads(path.read_text(encoding="utf-8")))
        except FileNotFoundError:
            return None
        except (OSError, ValueError, RecursionError) as error:
            _log.warning("The opinion %s is damaged and is asked for again: %s", path, error)
            return None

    def _to_disk(self, dossier: Dossier, opinion: Opinion) -> None:
        path = self._place(dossier)
        if path is None:
            return
        try:
            path.parent.mkdir(parents=True, exist_ok=True)
            handle, name = tempfile.mkstemp(dir=path.parent, prefix=".writing-")
            with os.fdopen(handle, "w", encoding="utf-8") as file:
                json.dump(to_json(opinion), file, ensure_ascii=False)
            os.replace(name, path)
        except OSError as error:
            # It is in memory: the run goes on, a restart asks again.
            _log.warning("An opinion cannot be kept in %s: %s", self._folder, error)
