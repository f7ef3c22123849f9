"""A real Chromium, spoken to over its debugging pipe; for tests of the page.

One serves all tests of a process, for it takes longer to start than most of them take. Each test
has a tab in a profile of its own: it sees no cookie and no store of another one's.
"""

from __future__ import annotations

import atexit
import base64
import contextlib
import json
import os
import select
import shutil
import subprocess
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "chrome"))), None)


class Chromium:
    """The program. Commands go out on one pipe, answers and events come back on another."""

    def __init__(self) -> None:
        assert CHROMIUM is not None
        self._number = 0
        self._buffer = b""
        self._folder = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        there, self._out = os.pipe()
        self._back, here = os.pipe()
        command = [
            CHROMIUM,
            "--headless",
            "--no-sandbox",
            "--disable-gpu",
            "--no-first-run",
            "--disable-dev-shm-usage",
            "--remote-debugging-pipe",
            f"--user-data-dir={self._folder.name}",
        ]
        # Chromium reads commands from descriptor 3 and answers on 4.
        shell = f'exec "$@" 3<&{there} 4>&{here}'
        self._process = subprocess.Popen(
            ["/bin/bash", "-c", shell, "bash", *command],
            pass_fds=(there, here),
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        os.close(there)
        os.close(here)

    def call(
        self, method: str, params: dict[str, Any], session: str | None, errors: list[str]
    ) -> dict[str, Any]:
        """One command, and its answer; what goes wrong in the page meanwhile is noted."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": params}
        if session is not None:
            message["sessionId"] = session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._receive(60)
            if answer.get("sessionId") == session:
                errors += _errors_in(answer)
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                result: dict[str, Any] = answer["result"]
                return result

    def close(self) -> None:
        """End it. Idempotent."""
        if self._process.poll() is None:
            self._process.kill()
            self._process.wait()
            os.close(self._out)
            os.close(self._back)
            self._folder.cleanup()

    def _receive(self, seconds: float) -> dict[str, Any]:
        while b"\0" not in self._buffer:
            if not select.select([self._back], [], [], seconds)[0]:
                raise TimeoutError("the browser does not answer")
            came = os.read(self._back, 1 << 16)
            if not came:
                raise TimeoutError("the browser has ended")
            self._buffer += came
        first, _, self._buffer = self._buffer.partition(b"\0")
        message: dict[str, Any] = json.loads(first)
        return message


def _errors_in(message: dict[str, Any]) -> list[str]:
    if message.get("method") == "Runtime.exceptionThrown":
        return [str(message["params"]["exceptionDetails"])]
    if message.get("method") == "Runtime.consoleAPICalled" and message["params"]["type"] == "error":
        return [str(message["params"]["args"])]
    return []


class Browser:
    """One tab."""

    def __init__(self, program: Chromium, profile: str, size: tuple[int, int]) -> None:
        self._program = program
        self._session: str | None = None
        self.errors: list[str] = []
        target = self.call(
            "Target.createTarget", url="about:blank", browserContextId=profile,
            width=size[0], height=size[1],
        )["targetId"]  # fmt: skip
        attached = self.call("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        self.call("Runtime.enable")
        self.call("Page.enable")

    def call(self, method: str, **params: Any) -> dict[str, Any]:
        """One command of the DevTools protocol, and its answer."""
        return self._program.call(method, params, self._session, self.errors)

    def run(self, script: str) -> Any:
        """The value of a JavaScript expression; promises are awaited."""
        answer = self.call(
            "Runtime.evaluate", expression=script, returnByValue=True, awaitPromise=True
        )
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{script}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def open(self, url: str) -> None:
        """Go to an address."""
        self.call("Page.navigate", url=url)

    def until(self, script: str, seconds: float = 60) -> None:
        """Return as soon as an expression is true; it is looked at after every change."""
        deadline = time.monotonic() + seconds
        while time.monotonic() < deadline:
            # A navigation throws the waiting promise away; then ask again.
            with contextlib.suppress(RuntimeError):
                if self.run(
                    "new Promise((done) => { const look = () => { let found = null; "
                    f"try {{ found = Boolean({script}); }} catch (error) {{ }} "
                    "if (found) { watch.disconnect(); done(found); } }; "
                    "const watch = new MutationObserver(look); "
                    "watch.observe(document, {subtree: true, childList: true, attributes: true,"
                    " characterData: true}); look(); setTimeout(() => done(false), 1000); })"
                ):
                    return
        raise AssertionError(f"never true: {script}; errors: {self.errors}")

    def screenshot(self, path: Path) -> None:
        """The page as PNG."""
        data = self.call("Page.captureScreenshot", format="png")["data"]
        path.write_bytes(base64.b64decode(data))


_programs: list[Chromium] = []


@contextlib.contextmanager
def chromium(size: tuple[int, int] = (1700, 900)) -> Iterator[Browser]:
    """A tab with a profile of its own."""
    if not _programs:
        _programs.append(Chromium())
        atexit.register(_programs[-1].close)
    program = _programs[-1]
    try:
        profile = program.call("Target.createBrowserContext", {}, None, [])["browserContextId"]
        yield Browser(program, profile, size)
        program.call("Target.disposeBrowserContext", {"browserContextId": profile}, None, [])
    except BaseException:
        _programs.clear()  # whatever it was, the next test begins with another one
        program.close()
        raise
