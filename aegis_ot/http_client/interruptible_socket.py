"""A socket that never blocks for long: between short waits it asks whether the run is stopping.

``http.client`` knows one timeout and leaves its reader unusable after it, so a wait that can be
called off has to happen below it, in the socket that it reads from.
"""

from __future__ import annotations

import io
import selectors
import socket
import ssl
import threading
import time
from collections.abc import Callable
from typing import Any

SLICE_S = 0.1
"""Longest single wait between two looks at the run, s. A stop must end it within 0.5 s."""

CheckStop = Callable[[], None]


class Waiter:
    """Waits in slices until something happens, a deadline passes, or ``check_stop`` raises."""

    def __init__(self, check_stop: CheckStop) -> None:
        self.check_stop = check_stop
        self.deadline = 0.0

    def begin(self, seconds: float) -> None:
        """Set the deadline for all waits from now on."""
        self.deadline = time.monotonic() + seconds

    @property
    def left(self) -> float:
        """Seconds until the deadline, 0 after it."""
        return max(0.0, self.deadline - time.monotonic())

    def check(self) -> None:
        """Raise what ``check_stop`` raises, or :class:`TimeoutError` after the deadline."""
        self.check_stop()
        if self.left <= 0:
            raise TimeoutError("no answer in time")

    def until_ready(self, sock: socket.socket, write: bool = False) -> None:
        """Wait until ``sock`` can be read (or written).

        Raises:
            TimeoutError: The deadline passed.
        """
        while True:
            self.check_stop()
            wait = min(SLICE_S, self.left)
            # Not select.select: it refuses descriptors above 1023, which a server may reach.
            with selectors.DefaultSelector() as selector:
                selector.register(sock, selectors.EVENT_WRITE if write else selectors.EVENT_READ)
                if selector.select(wait):
                    return
            self.check()

    def until_done(self, thread: threading.Thread) -> None:
        """Wait for a helper thread; :class:`TimeoutError` as above."""
        while thread.is_alive():
            self.check()
            thread.join(min(SLICE_S, self.left))


class InterruptibleSocket:
    """What ``http.client`` needs of a socket, over a non-blocking one."""

    def __init__(self, sock: socket.socket, waiter: Waiter) -> None:
        self._sock = sock
        self._waiter = waiter

    def sendall(self, data: bytes) -> None:
        """Send everything before the deadline."""
        view = memoryview(data)
        while view:
            try:
                view = view[self._sock.send(view) :]
            except (BlockingIOError, ssl.SSLWantWriteError):
                self._waiter.until_ready(self._sock, write=True)
            except ssl.SSLWantReadError:
                self._waiter.until_ready(self._sock)

    def makefile(self, *_args: Any, **_kwargs: Any) -> io.BufferedReader:
        """A reader for one answer."""
        return io.BufferedReader(_Reader(self._sock, self._waiter))

    def close(self) -> None:
        """Close the connection."""
        self._sock.close()


class _Reader(io.RawIOBase):
    def __init__(self, sock: socket.socket, waiter: Waiter) -> None:
        self._sock = sock
        self._waiter = waiter

    def readable(self) -> bool:
        return True

    def readinto(self, buffer: Any) -> int:
        # Here too, not only while nothing comes: an answer without an end never waits.
        self._waiter.check()
        while True:
            try:
                return self._sock.recv_into(buffer)
            except (BlockingIOError, ssl.SSLWantReadError):
                self._waiter.until_ready(self._sock)
            except ssl.SSLWantWriteError:
                self._waiter.until_ready(self._sock, write=True)


def connect(host: str, port: int, tls: bool, waiter: Waiter) -> InterruptibleSocket:
    """Connect before the waiter's deadline, to the first address that answers.

    Raises:
        OSError: Refused, no such host, no route; :class:`TimeoutError` after the deadline.
    """
    error: OSError = OSError(f"{host} has no address")
    for family, kind, protocol, _, address in _addresses(host, port, waiter):
        sock = socket.socket(family, kind, protocol)
        try:
            sock.setblocking(False)
            sock.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            _finish_connect(sock, address, waiter)
            return InterruptibleSocket(_secure(sock, host, waiter) if tls else sock, waiter)
        except OSError as failure:
            sock.close()
            if isinstance(failure, TimeoutError) and waiter.left <= 0:
                raise
            error = failure
        except BaseException:
            sock.close()
            raise
    raise error


def _finish_connect(sock: socket.socket, address: Any, waiter: Waiter) -> None:
    try:
        sock.connect(address)
    except BlockingIOError:
        waiter.until_ready(sock, write=True)
        number = sock.getsockopt(socket.SOL_SOCKET, socket.SO_ERROR)
        if number:
            raise OSError(number, _strerror(number)) from None


def _strerror(number: int) -> str:
    import os

    return os.strerror(number)


def _secure(sock: socket.socket, host: str, waiter: Waiter) -> socket.socket:
    context = ssl.create_default_context()
    secured = context.wrap_socket(sock, server_hostname=host, do_handshake_on_connect=False)
    while True:
        try:
            secured.do_handshake()
            return secured
        except ssl.SSLWantReadError:
            waiter.until_ready(secured)
        except ssl.SSLWantWriteError:
            waiter.until_ready(secured, write=True)


def _addresses(host: str, port: int, waiter: Waiter) -> list[Any]:
    """Resolve a name; a resolver can take many seconds and cannot be interrupted."""
    try:
        return socket.getaddrinfo(host, port, type=socket.SOCK_STREAM, flags=socket.AI_NUMERICHOST)
    except socket.gaierror:
        pass
    except UnicodeError as error:  # an empty label, or one of more than 63 characters
        raise OSError(f"{host!r} is no host name") from error
    answer: list[Any] = []
    failure: list[OSError] = []

    def resolve() -> None:
        try:
            answer.extend(socket.getaddrinfo(host, port, type=socket.SOCK_STREAM))
        except OSError as error:
            failure.append(error)

    thread = threading.Thread(target=resolve, name="aegis-ot-resolve", daemon=True)
    thread.start()
    waiter.until_done(thread)
    if failure:
        raise failure[0]
    return answer
