"""A rehearsal wastes no time, ends when it should, and leaves nothing behind."""

from __future__ import annotations

import pickle
import threading
import time
from contextlib import contextmanager

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script, interrupted_after, record, second_clock
from aegis_ot.adapters.opentrons.rehearsal.virtual_time import builtins_in_virtual_time
from aegis_ot.errors import RehearsalError, RehearsalTimeout


def script(body: str) -> Script:
    head = 'import time\nfrom time import sleep\nmetadata = {"apiLevel": "2.15"}\n\n'
    lines = "\n".join(f"    {line}" for line in body.splitlines())
    return Script(f"{head}def run(protocol):\n{lines}\n", "protocol.py")


def executed(text: str) -> dict:
    names = {"__builtins__": builtins_in_virtual_time()}
    exec(text, names)
    return names


def test_what_was_recorded_goes_to_another_process():
    recording = record(
        script(
            "tips = protocol.load_labware('opentrons_96_tiprack_20ul', 1)\n"
            "plate = protocol.load_labware('biorad_96_wellplate_200ul_pcr', 2)\n"
            "p20 = protocol.load_instrument('p20_single_gen2', 'left', [tips])\n"
            "p20.transfer(5, plate['A1'], plate['A2'])"
        )
    )
    assert recording.log
    assert pickle.loads(pickle.dumps(recording)) == recording


def test_a_plunger_s_speed_is_set_as_on_a_robot_of_older_levels():
    text = script(
        "p20 = protocol.load_instrument('p20_single_gen2', 'left')\n"
        "p20.speed.aspirate = 2 * p20.speed.dispense"
    ).text
    assert record(Script(text.replace("2.15", "2.13"), "protocol.py")).log is not None
    with pytest.raises(RehearsalError, match="flow_rate"):
        record(Script(text, "protocol.py"))


class TestVirtualTime:
    def test_sleeps_pass_at_once_and_the_clocks_know(self):
        names = executed(
            "import time, time as t\nfrom time import sleep, monotonic\n"
            "a, b, c = time.time(), monotonic(), time.perf_counter()\n"
            "sleep(100_000); t.sleep(200_000)\n"
            "gone = (time.time() - a, monotonic() - b, time.perf_counter() - c)\n"
        )
        assert names["gone"] == pytest.approx((300_000,) * 3, abs=1000)

    def test_waiting_for_the_clock_ends(self):
        executed("import time\nend = time.time() + 3600\nwhile time.time() < end: time.sleep(10)\n")

    @pytest.mark.parametrize("wrong", ["-1", "'x'", ""])
    def test_what_the_real_one_refuses_is_refused(self, wrong):
        with pytest.raises((ValueError, TypeError)):
            executed(f"import time\ntime.sleep({wrong})")

    def test_the_real_module_is_untouched(self):
        before = dict(vars(time))
        executed("import time\ntime.sleep(5)")
        assert dict(vars(time)) == before

    def test_a_rehearsal_uses_it(self):
        record(script("sleep(30_000)\ntime.sleep(30_000)"))


class TestInterruption:
    def test_an_endless_loop_is_told_with_its_line(self):
        with pytest.raises(RehearsalTimeout, match=r"within 0\.3 s") as caught:
            record(script("while True:\n    pass"), timeout_s=0.3)
        assert caught.value.line in (6, 7)

    def test_one_that_swallows_everything_ends_too(self):
        body = "for _ in range(3):\n    try:\n        while True: pass\n    except: pass"
        with pytest.raises(RehearsalTimeout):
            record(script(body + "\nwhile True: pass"), timeout_s=0.3)

    def test_getting_ready_takes_nothing_from_the_time_of_the_protocol(self):
        """A busy machine may need longer than the limit until the protocol's first line."""
        told = []

        class Heard:
            def before(self, operation): ...
            def after(self, operation): ...
            def event(self, event):
                told.append(event.kind.value)

        @contextmanager
        def clock(limit_s):
            told.append(limit_s)
            yield
            told.append("over")

        with second_clock(clock):
            record(script("protocol.comment('first line')"), [Heard()], timeout_s=7)
        # Once for what stands outside of run, once for all of it.
        assert told == [7, "over", "labware_loaded", 7, "comment", "over"]

    def test_a_clock_around_others_ends_what_they_hold(self):
        told = pytest.raises(RehearsalTimeout, match=r"outer did not end within 0\.3 s")
        with told, interrupted_after(0.3, "outer"):
            record(script("while True: pass"), timeout_s=60)

    def test_a_stop_ends_it(self):
        stopping = threading.Event()
        threading.Timer(0.5, stopping.set).start()
        with pytest.raises(RehearsalError, match="stopped") as caught:
            record(script("while True: pass"), is_stopping=stopping.is_set)
        assert not isinstance(caught.value, RehearsalTimeout)

    def test_no_thread_is_left(self):
        before = set(threading.enumerate())
        record(script("pass"))
        until = time.monotonic() + 5
        while set(threading.enumerate()) - before:
            assert time.monotonic() < until, threading.enumerate()
            time.sleep(0.01)


def test_a_csv_file_that_the_rehearsal_read_is_whole_for_the_run():
    from opentrons.protocol_api._parameters import Parameters
    from opentrons.protocols.api_support.types import APIVersion
    from opentrons.protocols.parameters.csv_parameter_interface import CSVParameter

    live = Parameters({"table": CSVParameter(b"a,b", APIVersion(2, 20)), "count": 3})
    body = "with protocol.params.table.file as table:\n    assert table.read() == 'a,b'"
    text = script(body).text.replace("2.15", "2.20")
    record(Script(text, "protocol.py"), live_parameters=live)
    assert live.table.file.read() == "a,b"
    assert live.count == 3
