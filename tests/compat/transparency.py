"""Runs protocols guarded and unguarded and compares what the robot was told to do.

A plain program, so that it runs in an interpreter that has nothing but ``opentrons``::

    python -m tests.compat.transparency tests/protocols/transparency/*.py

prints one JSON object: versions, what the guard loads, and per protocol what was found. With
``--commands`` before the files run logs are compared only where there is nothing else. The guard
has a sidecar (a stub on loopback that answers every keyframe and passes every well) and acts in
simulation, so that both layers are at work; its comments, and its moves above a well, are the only
commands it may add. All others are compared with all their parameters.
"""

from __future__ import annotations

import io
import json
import os
import re
import signal
import sys
import threading
import traceback
from contextlib import contextmanager, suppress
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path


class _Stub(BaseHTTPRequestHandler):
    """Answers like a sidecar whose every well passes."""

    protocol_version = "HTTP/1.1"
    wbufsize = -1  # one packet per answer

    def _answer(self, body):
        data = json.dumps(body).encode()
        self.send_response(200)
        self.send_header("Content-Type", "application/json")
        self.send_header("Content-Length", str(len(data)))
        self.end_headers()
        self.wfile.write(data)

    def _body(self):
        length = int(self.headers.get("Content-Length") or 0)
        return json.loads(self.rfile.read(length) or b"{}")

    def do_GET(self):
        found = re.search(r"/runs/([^/]+)/trajectories/(\d+)/verdict", self.path)
        if not found:
            self._answer({"name": "aegis-ot", "version": "stub", "wire": 1,
                          "camera": {"kind": "stub", "ok": True, "detail": ""}})  # fmt: skip
            return
        self._answer(
            {
                "verdict": {
                    "run": found.group(1),
                    "trajectory": int(found.group(2)),
                    "outcome": "pass",
                    "route": "silent_pass",
                }
            }
        )

    def do_PUT(self):
        self._body()
        self._answer({"run": self.path.rsplit("/", 1)[-1], "wire": 1})

    def do_POST(self):
        body = self._body()
        if "/keyframes" in self.path:
            self.server.keyframes.append(body)
            self._answer({"sequence": body["sequence"], "captured": True, "exposed_after_s": 0.0})
        else:
            self._answer({})

    def log_message(self, *_):
        pass


@contextmanager
def stub_sidecar():
    """Serve the stub on loopback; yields its URL and the list of keyframes it got."""
    server = ThreadingHTTPServer(("127.0.0.1", 0), _Stub)
    server.keyframes = []
    server.daemon_threads = True
    threading.Thread(target=server.serve_forever, daemon=True).start()
    try:
        yield f"http://127.0.0.1:{server.server_port}", server.keyframes
    finally:
        server.shutdown()
        server.server_close()


def guarded_text(text, url):
    """The same protocol with the guard put around ``run``, line numbers unchanged."""
    return (
        f"{text}\n"
        f"run = __import__('aegis_ot').guard(run, sidecar={url!r}, watch_simulation=True, "
        f"rules='warn')\n"
    )


def simulate(text, name):
    """What the protocol did: the lines of its run log, and how it ended."""
    import opentrons.simulate as simulator

    try:
        log, _ = simulator.simulate(io.StringIO(text), name, log_level="none")
    except Exception as error:
        return {"log": None, "error": _error(error)}
    lines = [_plain(entry["payload"].get("text", "")) for entry in log]
    return {"log": [line for line in lines if not line.startswith("aegis")], "error": None}


def _error(error):
    """The error as the App shows it: what went wrong, and on which line."""
    # An engine's error prints as its whole record, traceback through the guard included.
    details = re.findall(r"detail=.(.*?)., errorInfo", str(error))
    text = "; ".join(details) or str(error)
    return _plain(f"{type(error).__name__}: {text}")


def _plain(text):
    """Without what differs from run to run: identifiers and times."""
    text = re.sub(r"0x[0-9a-f]+|[0-9a-f]{8}-[0-9a-f-]{27}", "ID", text)
    return re.sub(r"\d{4}-\d\d-\d\d.\d\d:\d\d:\d\d(\.\d+)?", "TIME", text)


def engine_commands(text, name):
    """Commands of an engine run with all their parameters, or ``None`` (legacy core)."""
    from opentrons.protocol_api._parameter_context import ParameterContext
    from opentrons.protocol_api.core.engine import ENGINE_CORE_API_VERSION
    from opentrons.protocols.execution.execute_python import exec_add_parameters, exec_run
    from opentrons.protocols.parse import parse

    from aegis_ot.adapters.opentrons.rehearsal.simulated_context import simulated_context

    try:
        protocol = parse(text, name)
    except Exception:  # no protocol; how that ends was compared
        return None
    if protocol.api_level < ENGINE_CORE_API_VERSION:
        return None
    with simulated_context(protocol.api_level, protocol.robot_type) as context:
        parameters = exec_add_parameters(
            protocol, ParameterContext(api_version=protocol.api_level), None, None
        )
        error = None
        try:
            exec_run(protocol, context, parameters)
        except Exception as raised:
            error = _error(raised)
        state = context._core._engine_client.state
        found = []
        ids = {}
        for command in state.commands.get_all():
            params = _params(command)
            text_params = json.dumps(params, sort_keys=True, default=str)
            for found_id in re.findall(r"[0-9a-f]{8}-[0-9a-f-]{27}", text_params):
                ids.setdefault(found_id, f"id{len(ids)}")
            for found_id, plain in ids.items():
                text_params = text_params.replace(found_id, plain)
            found.append(f"{command.commandType} {_plain(text_params)}")
        return {"commands": found, "error": error}


def without_added(plain, guarded):
    """The guarded commands without those that the guard may add to the plain ones."""
    left = []
    for command in guarded:
        expected = plain[len(left)] if len(left) < len(plain) else None
        added = command.startswith(("moveToWell ", 'comment {"message": "aegis'))
        if command == expected or not added:
            left.append(command)
    return left


def _params(command):
    model = command.params
    if hasattr(model, "model_dump"):
        return model.model_dump(mode="json", exclude_none=True)
    return json.loads(model.json(exclude_none=True))  # opentrons 8.2 and older


def compare(path, url, keyframes, logs=True):
    """Compare one protocol; returns a dict for the report."""
    return compare_text(path.read_text(encoding="utf-8"), path.name, url, keyframes, logs)


def compare_text(text, name, url, keyframes, logs=True):
    """Without ``logs`` an engine's protocol is run for its commands alone, which say all that its
    run log says: half of the time. A legacy protocol has no more than its log."""
    guarded = guarded_text(text, url)
    del keyframes[:]
    result = {"file": name, "problems": [], "own_error": None, "engine_commands": None, "lines": 0}
    engine_plain = engine_commands(text, name)
    if engine_plain is not None:
        engine_guarded = engine_commands(guarded, name)
        left = without_added(engine_plain["commands"], engine_guarded["commands"])
        if left != engine_plain["commands"] or engine_plain["error"] != engine_guarded["error"]:
            result["problems"].append(
                "engine commands differ: "
                + _first(engine_plain["commands"], left)
                + f" ({engine_plain['error']} / {engine_guarded['error']})"
            )
        result["engine_commands"] = len(engine_plain["commands"])
        result["own_error"] = engine_plain["error"]
    if logs or engine_plain is None:
        del keyframes[:]
        plain, watched = simulate(text, name), simulate(guarded, name)
        if plain["error"] != watched["error"]:
            result["problems"].append(f"error {plain['error']!r} became {watched['error']!r}")
        if plain["log"] != watched["log"]:
            result["problems"].append(f"run log differs: {_first(plain['log'], watched['log'])}")
        result |= {"lines": len(plain["log"] or ()), "own_error": plain["error"]}
    return result | {"keyframes": len(keyframes)}


def _first(one, other):
    for index, (a, b) in enumerate(zip(one or (), other or (), strict=False)):
        if a != b:
            return f"at {index}: {a!r} / {b!r}"
    return f"lengths {len(one or ())} / {len(other or ())}"


_USUAL = """
requirements = {{"robotType": "{robot}", "apiLevel": "{level}"}}
def run(protocol):
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "{slots[0]}")
    tips = protocol.load_labware("opentrons_{tips}_200ul", "{slots[1]}")
    trash = protocol.load_trash_bin("A3") if "{robot}" == "Flex" else None
    pipette = protocol.load_instrument("{pipette}", "left", [tips])
    pipette.transfer(50, plate["A1"], plate["B1"])
"""


def warm_up():
    """Load and cache before the forks what all of them need; what no protocol spoils."""
    ot2 = {"robot": "OT-2", "slots": "12", "tips": "96_filtertiprack", "pipette": "p300_single"}
    flex = {"robot": "Flex", "slots": ("D1", "D2"), "tips": "flex_96_tiprack",
            "pipette": "flex_1channel_1000"}  # fmt: skip
    for robot, level in ((ot2, "2.13"), (ot2, "2.15"), (flex, "2.16")):
        # Not every release simulates both robots.
        with suppress(Exception), stub_sidecar() as (url, keyframes):
            compare_text(_USUAL.format(level=level, **robot), "usual.py", url, keyframes)
    assert threading.active_count() == 1, "a fork would lack what its locks belong to"


def compare_apart(path, processor_s, logs=True):
    """The same in a fork: a protocol may end its process, never end, or spoil it for the next."""
    reading, writing = os.pipe()
    pid = os.fork()
    if pid == 0:
        try:
            os.dup2(os.open(os.devnull, os.O_RDWR), 1)
            signal.setitimer(signal.ITIMER_PROF, processor_s)
            signal.alarm(20 * processor_s)  # it waits for something
            with stub_sidecar() as (url, keyframes):
                found = compare(path, url, keyframes, logs)
        except Exception:
            found = {"file": path.name, "problems": [traceback.format_exc()]}
        finally:
            with os.fdopen(writing, "w") as pipe:
                json.dump(found, pipe)
            os._exit(0)
    os.close(writing)
    with os.fdopen(reading) as pipe:
        said = pipe.read()
    code = os.waitstatus_to_exitcode(os.waitpid(pid, 0)[1])
    late = code in (-signal.SIGALRM, -signal.SIGPROF)
    ended = "takes too long" if late else f"ends its process ({code})"
    return json.loads(said) if said else {"file": path.name, "problems": [], "own_error": ended}


def modules_of_the_guard():
    """The top-level modules that the robot half loads beyond those of ``opentrons``."""
    before = set(sys.modules)
    import aegis_ot.adapters.opentrons.instrumentation
    import aegis_ot.adapters.opentrons.rehearsal
    import aegis_ot.guard
    import aegis_ot.guarded_run
    import aegis_ot.preflight.check_protocol
    import aegis_ot.runtime
    import aegis_ot.settings  # noqa: F401

    return sorted({name.partition(".")[0] for name in set(sys.modules) - before})


def main(files, processor_s=300, logs=True):
    import opentrons.simulate  # once, before the forks

    modules = modules_of_the_guard()
    warm_up()
    results = [compare_apart(path, processor_s, logs) for path in map(Path, files)]
    print(json.dumps({"opentrons": opentrons.__version__, "python": sys.version.split()[0],
                      "modules": modules, "protocols": results}))  # fmt: skip


if __name__ == "__main__":
    import logging

    logging.disable(logging.CRITICAL)
    given = sys.argv[1:]
    if given[0].startswith("--each="):
        main(given[1:], int(given[0].partition("=")[2]))
    elif given[0] == "--commands":
        main(given[1:], logs=False)
    else:
        main(given)
