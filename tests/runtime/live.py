"""A live run on Opentrons' own engine and hardware simulator, with play, pause and stop.

As on a robot, the protocol runs in a worker thread, ``is_simulating()`` is false, and stop and
pause come from the event loop.
"""

from __future__ import annotations

import asyncio
import inspect
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from opentrons.protocol_reader import ProtocolReader
from opentrons.protocols.parse import PythonParseMode

from aegis_ot.adapters.opentrons.instrumentation.tap import tapped
from aegis_ot.runtime import Watcher
from aegis_ot.settings import Settings

from ..support.live_engine import make_hardware, make_live

_TEXT = """
{kind} = {{"apiLevel": "{api}"{robot}}}

def run(protocol):
    import sys
    sys.modules["{module}"].RUNNING["{key}"](protocol)
"""

RUNNING: dict[str, Callable[[Any], None]] = {}


class LiveRun:
    """One live run: of a function under a watcher, or of a protocol's text as it is.

    Attributes:
        watcher: Once the protocol has begun.
        error: What the protocol raised, as the protocol saw it.
    """

    def __init__(
        self,
        protocol: Callable[[Any], None] | str,
        settings: Settings | None = None,
        api: str = "2.15",
        robot: str = "OT-2",
        recover: Any = None,
    ) -> None:
        self._protocol = protocol
        self._settings = settings or Settings()
        self._api = api
        self._robot, self._recover = robot, recover
        self._ready = threading.Event()
        self._thread = threading.Thread(target=lambda: asyncio.run(self._main()), daemon=True)
        self.watcher: Watcher | None = None
        self.error: BaseException | None = None
        self.crash: BaseException | None = None
        self.commands: list[Any] = []

    def start(self) -> LiveRun:
        self._thread.start()
        assert self._ready.wait(60)
        return self

    def play(self) -> None:
        self._press("play")

    def pause(self) -> None:
        self._press("pause")

    def stop(self) -> None:
        self._press("stop")

    def retry(self) -> None:
        """Leave error recovery: the protocol goes on after the command that failed."""
        self._press("resume_from_recovery", False)

    @property
    def status(self) -> str:
        return str(self._ask("get_run_status").value)

    @property
    def told(self) -> str:
        """The errors in which the run ended, as the App shows them."""
        return "\n".join(error.model_dump_json() for error in self._ask("get_state_summary").errors)

    @property
    def groups(self) -> list[Any]:
        """The groups of steps, where this ``opentrons`` has such."""
        known = hasattr(self._orchestrator, "get_all_command_annotations")
        return list(self._ask("get_all_command_annotations")) if known else []

    def seen(self) -> list[Any]:
        """The commands so far, as the App would list them."""
        return list(self._ask("get_all_commands"))

    def _press(self, name: str, *arguments: Any) -> None:
        asyncio.run_coroutine_threadsafe(self._call(name, *arguments), self._loop)

    def _ask(self, name: str) -> Any:
        if not inspect.iscoroutinefunction(getattr(self._orchestrator, name)):
            return getattr(self._orchestrator, name)()
        if self._thread.is_alive():
            return asyncio.run_coroutine_threadsafe(self._call(name), self._loop).result(60)
        return asyncio.run(self._call(name))

    async def _call(self, name: str, *arguments: Any) -> Any:
        """Opentrons 10 made coroutines of the orchestrator's methods."""
        done = getattr(self._orchestrator, name)(*arguments)
        return await done if inspect.isawaitable(done) else done

    def wait_for_status(self, status: str, timeout: float = 60.0) -> None:
        until = time.monotonic() + timeout
        while self.status != status:
            assert time.monotonic() < until, f"{self.status!r} instead of {status!r}"
            time.sleep(0.01)

    def join(self, timeout: float = 60.0) -> LiveRun:
        self._thread.join(timeout)
        assert not self._thread.is_alive(), "the run did not end"
        if self.crash is not None:
            raise self.crash
        return self

    def _guarded(self, protocol: Any) -> None:
        assert not isinstance(self._protocol, str)
        self.watcher = Watcher(protocol, self._settings, "live.py")
        code_file = self._protocol.__code__.co_filename
        try:
            with tapped(protocol, [self.watcher], code_file) as tap:
                self.watcher.begin(tap)
                try:
                    self._protocol(protocol)
                except BaseException as error:
                    self.watcher.end(error)
                    raise
                self.watcher.end(None)
        except BaseException as error:
            self.error = error
            raise

    def _text(self, key: str) -> str:
        if isinstance(self._protocol, str):
            return self._protocol
        kind = "requirements" if self._robot == "Flex" else "metadata"
        robot = f', "robotType": "{self._robot}"' if self._robot == "Flex" else ""
        return _TEXT.format(
            api=self._api, robot=robot, kind=kind, module="aegis_ot_live_harness", key=key
        )

    async def _main(self) -> None:
        try:
            await self._run()
        except BaseException as error:
            self.crash = error
        finally:
            self._ready.set()

    async def _run(self) -> None:
        key = f"{id(self)}"
        if not isinstance(self._protocol, str):
            RUNNING[key] = self._guarded
        sys.modules.setdefault("aegis_ot_live_harness", sys.modules[__name__])
        hardware = await make_hardware(self._robot)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "live.py"
            path.write_text(self._text(key), encoding="utf-8")
            source = await ProtocolReader().read_saved([path], directory=None)
            engine, runner, self._orchestrator = await make_live(
                hardware, source.config, self._robot, self._recover
            )
            self._loop = asyncio.get_running_loop()
            await runner.load(source, PythonParseMode.NORMAL, None, None)
            self._ready.set()
            try:
                await self._orchestrator.run(deck_configuration=[])
            finally:
                self.commands = engine.state_view.commands.get_all()
                RUNNING.pop(key, None)
                await hardware.clean_up()
