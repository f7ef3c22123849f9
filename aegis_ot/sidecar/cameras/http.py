"""A network camera: an MJPEG stream, or an address that gives one picture per request."""

from __future__ import annotations

import base64
import http.client
import itertools
import socket
import threading
import time
import urllib.error
import urllib.parse
import urllib.request
from collections import deque
from email.message import Message
from typing import Any

from ...errors import CameraError
from ...settings import load_settings
from ...vocabulary import without_secrets
from .raw import Raw

SOCKET_TIMEOUT = 5.0
"""A camera that sends nothing for so long is opened again, s."""
PACE_OVER, PACE_OVER_S = 4, 1.0
"""The pace of a stream is looked at over so many pictures, and so many seconds, at least."""
UNKNOWN_PACE_S = 1.0
"""Of a stream that has just begun, s."""
SNAPSHOT_PERIOD = 0.1
"""Pictures are asked for at most this often, s."""
LARGEST_FRAME = 32 * 1024 * 1024
CHUNK = 16 * 1024


class HttpSource:
    """Reads ``url``; its content type tells whether it is a stream or a single picture.

    A user name and password in the address are sent as basic authentication and never shown; no
    other host sees them, for no redirect to one is followed.

    No such camera tells when it exposed a picture, so it is dated by what is certain. A picture of
    a stream began to arrive at a known moment, ``latency`` at most after its exposure began, and
    had waited no longer than the longest pause between pictures lately: a camera that hands on
    its last picture but one, and one whose pictures pile up on their way, are both waited out. A
    single picture that differs from the one before was made after the last request that still got
    that one. A picture that comes again is no new one.

    Args:
        url: ``http://`` or ``https://``.
        latency: Longest time from the start of an exposure to the frame's arrival, s.
        robot: The address is that of a robot's own camera, which takes a picture when it is told
            to: slow, and seldom aimed at the tip, but evidence. It was exposed after that.

    Raises:
        CameraError: No answer, an error status, or something that is no picture.
    """

    def __init__(self, url: str, latency: float, robot: bool = False) -> None:
        self._request, self.shown = _request(url)
        self._robot = robot
        if robot:
            self._request.method = "POST"
            for name, value in load_settings().robot_headers().items():
                self._request.add_header(name, value)
        self._latency = latency
        self._pace = Pace()
        self._last: bytes | None = None
        self._stop = threading.Event()
        self._came = self._asked = time.monotonic()
        self._asked_before = self._asked
        self._answer = self._open()
        kind = self._answer.headers.get_content_type()
        self._boundary: bytes | None = None
        self._buffer = b""
        if kind.startswith("multipart/"):
            self._boundary = _boundary(self._answer.headers)
        elif not kind.startswith("image/"):
            self._answer.close()
            raise CameraError(f"{self.shown} answers with {kind}, which is no picture or stream.")

    def read(self) -> Raw:
        """The next frame that is a new one. Raises CameraError when the camera is gone, or gives
        the same one again and again."""
        until = time.monotonic() + SOCKET_TIMEOUT
        try:
            while time.monotonic() < until:
                raw = self._part() if self._boundary is not None else self._snapshot()
                before, self._last = self._last, _picture(raw.jpeg or b"")
                # The very first one may be of any time.
                if self._robot or before not in (None, self._last):
                    return raw
        except (OSError, http.client.HTTPException) as error:
            raise CameraError(f"{self.shown} broke off: {_reason(error)}") from error
        raise CameraError(f"{self.shown} has sent the same picture for {SOCKET_TIMEOUT:g} s.")

    def close(self) -> None:
        """Close the connection."""
        self._stop.set()
        self._answer.close()

    def _open(self) -> http.client.HTTPResponse:
        try:
            answer: http.client.HTTPResponse = _OPENER.open(self._request, timeout=SOCKET_TIMEOUT)
        except urllib.error.HTTPError as error:
            error.close()
            told = f"{self.shown} answers with status {error.code}."
            if self._robot and error.code in (401, 403):
                told += " Its access is controlled: give its token as AEGIS_OT_ROBOT_TOKEN."
            raise CameraError(told) from error
        except (OSError, http.client.HTTPException, ValueError) as error:
            raise CameraError(f"{self.shown} cannot be reached: {_reason(error)}") from error
        return answer

    def _snapshot(self) -> Raw:
        if self._answer.isclosed():
            self._stop.wait(max(0.0, self._asked + SNAPSHOT_PERIOD - time.monotonic()))
            self._asked_before, self._asked = self._asked, time.monotonic()
            self._answer = self._open()
        data = self._answer.read(LARGEST_FRAME)
        self._answer.close()
        since = self._asked if self._robot else self._asked_before
        return Raw(since - self._latency, jpeg=data)

    def _part(self) -> Raw:
        """One part of ``multipart/x-mixed-replace``: boundary line, headers, blank line, JPEG."""
        assert self._boundary is not None
        self._until(self._boundary)
        length = _content_length(self._until(b"\r\n\r\n"))
        while not self._buffer:
            self._more()
        began = self._came
        if length is not None:
            while len(self._buffer) < length:
                self._more()
            data, self._buffer = self._buffer[:length], self._buffer[length:]
        else:
            # Without a length the frame ends where the next boundary begins; leave that there.
            data = self._until(self._boundary)
            self._buffer = self._boundary + self._buffer
            data = data[:-2] if data.endswith(b"\r\n") else data
        if _picture(data) != self._last:
            self._pace.next(began)
        return Raw(began - self._latency - self._pace.longest_s, jpeg=data)

    def _until(self, mark: bytes) -> bytes:
        start = 0
        while (at := self._buffer.find(mark, start)) < 0:
            start = max(0, len(self._buffer) - len(mark))
            self._more()
        found, self._buffer = self._buffer[:at], self._buffer[at + len(mark) :]
        return found

    def _more(self) -> None:
        if len(self._buffer) > LARGEST_FRAME:
            raise CameraError(f"{self.shown} sends parts of more than {LARGEST_FRAME} bytes.")
        # read1 returns what has arrived; read would wait for a full chunk, frames later.
        chunk = self._answer.read1(CHUNK)
        self._came = time.monotonic()
        if not chunk:
            raise CameraError(f"{self.shown} ended the stream.")
        self._buffer += chunk


class Pace:
    """How far apart the pictures of a stream have come lately."""

    def __init__(self) -> None:
        self._began: deque[float] = deque()

    def next(self, began: float) -> None:
        """A picture began to arrive, ``time.monotonic``, s."""
        self._began.append(began)
        # A pause is kept until what had piled up in it has surely come.
        while len(self._began) > PACE_OVER and self._began[1] < began - PACE_OVER_S:
            self._began.popleft()

    @property
    def longest_s(self) -> float:
        """The longest pause between two of them, s."""
        began = self._began
        pauses = [later - earlier for earlier, later in itertools.pairwise(began)]
        # A server may begin with all that it has kept: pictures at once, and old.
        known = len(began) >= PACE_OVER and began[-1] - began[0] >= PACE_OVER_S
        return max(pauses if known else [UNKNOWN_PACE_S, *pauses])


class _SameHost(urllib.request.HTTPRedirectHandler):
    """Follows no redirect to another host, or to no encryption: that would tell the password."""

    def redirect_request(
        self, req: urllib.request.Request, fp: Any, code: int, msg: str, headers: Any, newurl: str
    ) -> urllib.request.Request | None:
        new, old = urllib.parse.urlsplit(newurl), urllib.parse.urlsplit(req.full_url)
        if new.netloc != old.netloc or new.scheme not in (old.scheme, "https"):
            raise CameraError(
                f"{without_secrets(req.full_url)} sends on to another host, which is not followed. "
                "Name the address where the pictures are."
            )
        return super().redirect_request(req, fp, code, msg, headers, newurl)


_OPENER = urllib.request.build_opener(urllib.request.ProxyHandler({}), _SameHost)


def _picture(jpeg: bytes) -> bytes:
    """What is picture in a JPEG: a comment or a time in its header makes no new one."""
    return jpeg[max(0, jpeg.find(b"\xff\xda")) :]


def _request(url: str) -> tuple[urllib.request.Request, str]:
    """The request for ``url``, and the address as it may be shown: without the password."""
    try:
        parts = urllib.parse.urlsplit(url)
        host = f"[{parts.hostname}]" if ":" in (parts.hostname or "") else parts.hostname
        place = f"{host}:{parts.port}" if parts.port else f"{host}"
    except ValueError as error:
        raise CameraError(f"The camera's address makes no sense: {error}") from error
    bare = urllib.parse.urlunsplit((parts.scheme, place, parts.path, parts.query, ""))
    request = urllib.request.Request(bare, headers={"User-Agent": "aegis-ot"})
    if parts.username is not None:
        pair = urllib.parse.unquote(f"{parts.username}:{parts.password or ''}")
        request.add_header("Authorization", "Basic " + base64.b64encode(pair.encode()).decode())
    return request, without_secrets(url)


def _boundary(headers: Message) -> bytes:
    boundary = headers.get_param("boundary")
    text = boundary if isinstance(boundary, str) else ""
    if not text:
        raise CameraError("The stream does not name the boundary of its parts.")
    # Some cameras write the two dashes into the parameter as well.
    return b"--" + text.strip('"').removeprefix("--").encode("latin-1")


def _content_length(head: bytes) -> int | None:
    for line in head.split(b"\r\n"):
        name, _, value = line.partition(b":")
        if name.strip().lower() == b"content-length" and value.strip().isdigit():
            length = int(value)
            if length > LARGEST_FRAME:
                raise CameraError(f"The stream announces a frame of {length} bytes.")
            return length
    return None


def _reason(error: Exception) -> str:
    reason = getattr(error, "reason", error)
    if isinstance(reason, (TimeoutError, socket.timeout)):
        return f"nothing came for {SOCKET_TIMEOUT:g} s"
    return str(reason) or type(reason).__name__
