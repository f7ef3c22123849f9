"""Addresses as they may be shown: they carry passwords, tokens and keys in many places."""

from __future__ import annotations

import re

_URL = re.compile(r"(?P<scheme>[A-Za-z][\w+.-]*)://(?P<place>[^\s/?#\"'<>]*)(?P<rest>[^\s\"'<>]*)")


def without_secrets(text: str) -> str:
    """A text whose addresses name scheme, host and port alone.

    User name and password, path and query go: cameras and services take keys in each of them.

    >>> without_secrets("rtsp://ada:secret@cam.local:554/live?key=1 ended the stream.")
    'rtsp://cam.local:554/... ended the stream.'
    """

    def shown(found: re.Match[str]) -> str:
        rest = found["rest"]
        place = found["place"]
        # A password that was not quoted may hold what ends a host: then an @ is still to come.
        if "@" not in place and "@" in rest and not re.fullmatch(r"(\[.*\]|[^:]*)(:\d*)?", place):
            place += rest
        host = re.split(r"[/?#]", place.rpartition("@")[2])[0]
        end = rest[len(rest.rstrip(".,;:)!")) :]
        return f"{found['scheme']}://{host}" + ("/..." if len(rest.strip(".,;:)!/")) else "") + end

    return _URL.sub(shown, text)
