"""A real Chromium, spoken to over its debugging pipe; for tests of the page."""

from __future__ import annotations

import base64
import contextlib
import json
import os
import select
import shutil
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

CHROMIUM = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "chrome"))), None)


class Browser:
    """One tab. Commands go out on one pipe, answers and events come back on another."""

    def __init__(self, out: int, back: int) -> None:
        self._out, self._back = out, back
        self._number = 0
        self._buffer = b""
        self._session: str | None = None
        self.errors: list[str] = []
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        attached = self.call("Target.attachToTarget", targetId=target, flatten=True)
        self._session = attached["sessionId"]
        self.call("Runtime.enable")
        self.call("Page.enable")

    def call(self, method: str, **params: Any) -> dict[str, Any]:
        """One command of the DevTools protocol, and its answer."""
        self._number += 1
        message = {"id": self._number, "method": method, "params": params}
        if self._session is not None:
            message["sessionId"] = self._session
        os.write(self._out, json.dumps(message).encode() + b"\0")
        while True:
            answer = self._receive(20)
            if answer.get("id") == self._number:
                if "error" in answer:
                    raise RuntimeError(f"{method}: {answer['error']}")
                result: dict[str, Any] = answer["result"]
                return result

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

    def until(self, script: str, seconds: float = 15) -> None:
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

    def _receive(self, seconds: float) -> dict[str, Any]:
        while b"\0" not in self._buffer:
            if not select.select([self._back], [], [], seconds)[0]:
                raise TimeoutError("the browser does not answer")
            self._buffer += os.read(self._back, 1 << 16)
        first, _, self._buffer = self._buffer.partition(b"\0")
        message: dict[str, Any] = json.loads(first)
        if message.get("method") == "Runtime.exceptionThrown":
            self.errors.append(str(message["params"]["exceptionDetails"]))
        if message.get("method") == "Runtime.consoleAPICalled" and (
            message["params"]["type"] == "error"
        ):
            self.errors.append(str(message["params"]["args"]))
        return message


@contextlib.contextmanager
def chromium(folder: Path, size: tuple[int, int] = (1700, 900)) -> Iterator[Browser]:
    """Start a browser with a profile of its own."""
    assert CHROMIUM is not None
    there, out = os.pipe()
    back, here = os.pipe()
    command = [
        CHROMIUM,
        "--headless",
        "--no-sandbox",
        "--disable-gpu",
        "--no-first-run",
        "--disable-dev-shm-usage",
        "--remote-debugging-pipe",
        f"--user-data-dir={folder}",
        f"--window-size={size[0]},{size[1]}",
    ]

    # Chromium reads commands from descriptor 3 and answers on 4.
    shell = f'exec "$@" 3<&{there} 4>&{here}'
    process = subprocess.Popen(
        ["/bin/bash", "-c", shell, "bash", *command],
        pass_fds=(there, here),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    )
    os.close(there)
    os.close(here)
    try:
        yield Browser(out, back)
    finally:
        process.kill()
        process.wait()
        os.close(out)
        os.close(back)
