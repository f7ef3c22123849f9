"""A live run on Opentrons' own engine and hardware simulator, with play, pause and stop.

As on a robot, the protocol runs in a worker thread, ``is_simulating()`` is false, and stop and
pause come from the event loop.
"""

from __future__ import annotations

import asyncio
import sys
import tempfile
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

from opentrons.hardware_control import API
from opentrons.protocol_reader import ProtocolReader
from opentrons.protocols.parse import PythonParseMode
from opentrons.types import Mount

from aegis_ot.instrumentation.tap import tapped
from aegis_ot.runtime import Watcher
from aegis_ot.settings import Settings

from ..support.live_engine import make_live

_TEXT = """
metadata = {{"apiLevel": "{api}"}}

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
        ended_at: ``time.monotonic`` at which the run was over.
    """

    def __init__(
        self,
        protocol: Callable[[Any], None] | str,
        settings: Settings | None = None,
        api: str = "2.15",
    ) -> None:
        self._protocol = protocol
        self._settings = settings or Settings()
        self._api = api
        self._ready = threading.Event()
        self._thread = threading.Thread(target=lambda: asyncio.run(self._main()), daemon=True)
        self.watcher: Watcher | None = None
        self.error: BaseException | None = None
        self.crash: BaseException | None = None
        self.ended_at = 0.0
        self.commands: list[Any] = []

    def start(self) -> LiveRun:
        self._thread.start()
        assert self._ready.wait(30)
        return self

    def play(self) -> None:
        self._loop.call_soon_threadsafe(self._orchestrator.play)

    def pause(self) -> None:
        self._loop.call_soon_threadsafe(self._orchestrator.pause)

    def stop(self) -> float:
        """Press stop; the time at which it was pressed."""
        pressed = time.monotonic()
        asyncio.run_coroutine_threadsafe(self._orchestrator.stop(), self._loop)
        return pressed

    @property
    def status(self) -> str:
        return str(self._orchestrator.get_run_status().value)

    @property
    def told(self) -> str:
        """The errors in which the run ended, as the App shows them."""
        return "\n".join(
            error.model_dump_json() for error in self._orchestrator.get_state_summary().errors
        )

    def seen(self) -> list[Any]:
        """The commands so far, as the App would list them."""
        return list(self._orchestrator.get_all_commands())

    def wait_for_status(self, status: str, timeout: float = 10.0) -> None:
        until = time.monotonic() + timeout
        while self.status != status:
            assert time.monotonic() < until, f"{self.status!r} instead of {status!r}"
            time.sleep(0.01)

    def join(self, timeout: float = 30.0) -> LiveRun:
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
        finally:
            self.ended_at = time.monotonic()

    def _text(self, key: str) -> str:
        if isinstance(self._protocol, str):
            return self._protocol
        return _TEXT.format(api=self._api, module="aegis_ot_live_harness", key=key)

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
        instruments = {
            Mount.LEFT: {"model": "p300_single_v2.1", "id": "left", "name": "p300_single_gen2"}
        }
        hardware = await API.build_hardware_simulator(attached_instruments=instruments)
        hardware._em_simulate = False  # wait and be cancelled as on a robot
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "live.py"
            path.write_text(self._text(key), encoding="utf-8")
            source = await ProtocolReader().read_saved([path], directory=None)
            engine, runner, self._orchestrator = await make_live(hardware, source.config)
            self._loop = asyncio.get_running_loop()
            await runner.load(source, PythonParseMode.NORMAL, None, None)
            self._ready.set()
            try:
                await self._orchestrator.run(deck_configuration=[])
            finally:
                self.commands = engine.state_view.commands.get_all()
                RUNNING.pop(key, None)
                await hardware.clean_up()
