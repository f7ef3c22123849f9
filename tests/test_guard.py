"""The guard as a protocol meets it: decorated or called, simulated or live."""

from __future__ import annotations

import contextvars
import inspect
import io
import os
import re
import sys
import textwrap

import pytest
from opentrons import simulate

import aegis_ot
from aegis_ot import guard
from aegis_ot.errors import ConfigurationError
from tests.compat.transparency import stub_sidecar
from tests.runtime.fake_sidecar import FakeSidecar, free_port
from tests.runtime.live import LiveRun
from tests.runtime.test_live import in_time

DECK = """
plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "plate")
tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2, "tubes")
tips = protocol.load_labware("opentrons_96_tiprack_300ul", 3)
p300 = protocol.load_instrument("p300_single_gen2", "left", [tips])
"""
WITH_PARAMETERS = """
metadata = {"apiLevel": "2.20", "protocolName": "HeLa cells, drug treatment"}

def add_parameters(parameters):
    parameters.add_int("Control column", "control_column", 12, minimum=1, maximum=12)

def run(protocol):
    cells = protocol.load_labware("corning_96_wellplate_360ul_flat", 1, "HeLa cells")
    tubes = protocol.load_labware("opentrons_24_tuberack_nest_1.5ml_snapcap", 2)
    tips = protocol.load_labware("opentrons_96_filtertiprack_20ul", 3)
    p20 = protocol.load_instrument("p20_single_gen2", "left", tip_racks=[tips])
    drug, vehicle = tubes["A1"], tubes["A2"]
    controls = cells.columns()[protocol.params.control_column - 1]
    treated = cells.columns()[0]
    p20.transfer(5, vehicle, controls[1:], new_tip="always")
    p20.transfer(5, drug, [*treated, controls[0]], new_tip="always")
"""
GOOD = 'p300.transfer(50, tubes["A1"], plate.wells()[:2], new_tip="always")'
BAD = """
template, water, ntc = tubes["A1"], tubes["A2"], plate["H12"]
sample = plate["A1"]
p300.pick_up_tip()
p300.aspirate(40, template)
p300.dispense(40, sample)
p300.aspirate(40, water)
p300.dispense(40, ntc)
p300.drop_tip()
"""


def protocol(body: str, settings: str = "", form: str = "decorator", level: str = "2.15") -> str:
    """The text of a guarded protocol."""
    setup = textwrap.indent(DECK + textwrap.dedent(body), "    ")
    head = f'from aegis_ot import guard\nmetadata = {{"apiLevel": "{level}"}}\n'
    if form == "decorator":
        return f"{head}@guard({settings})\ndef run(protocol):\n{setup}\n"
    call = f"    protocol = guard(protocol, {settings})\n"
    return f"{head}def run(protocol):\n{call}{setup}\n"


def simulated(text: str) -> list[str]:
    """Lines of the run log, as ``opentrons_simulate`` prints them."""
    log, _ = simulate.simulate(io.StringIO(text), "protocol.py", log_level="none")
    return [entry["payload"].get("text", "") for entry in log]


OPENING = "aegis_ot: Layer 1 rehearses the protocol; then the run begins."


def of_guard(lines: list[str]) -> list[str]:
    said = [line for line in lines if line.startswith("aegis_ot: ")]
    return [line for line in said if line != OPENING]


class TestDecoration:
    def test_the_signature_is_the_users(self):
        @guard(assay="pcr")
        def run(ctx): ...

        assert list(inspect.signature(run).parameters) == ["ctx"]
        assert run.__name__ == "run"

    def test_it_does_nothing_and_raises_nothing_even_with_wrong_settings(self, monkeypatch):
        def refuse(*_args, **_kwargs):
            raise AssertionError("I/O at decoration")

        monkeypatch.setattr("builtins.open", refuse)
        monkeypatch.setattr("aegis_ot.settings.load_settings", refuse)
        guard(no_such_setting=1, hold=7)(lambda protocol: None)

    def test_guarding_twice_is_guarding_once_the_outer_settings_win(self):
        @guard(rules="off", assay="pcr")
        def run(protocol): ...

        again = guard(run, rules="warn")
        assert again.__aegis_guard__[1] == {"rules": "warn", "assay": "pcr"}
        assert again.__aegis_guard__[0] is inspect.unwrap(run)

    @pytest.mark.parametrize("wrong", ['"pcr"', '{"assay": "pcr"}', "7", '"pcr", "http://x:1"'])
    def test_a_setting_without_a_name_is_reported_in_run_not_at_import(self, wrong):
        text = f"from aegis_ot import guard\n@guard({wrong})\ndef run(protocol): ...\n"
        namespace: dict = {}
        exec(text, namespace)
        with pytest.raises(ConfigurationError, match='assay="pcr"'):
            namespace["run"](None)

    def test_a_decorator_between_two_guards_still_acts(self):
        text = """
import functools
from aegis_ot import guard
metadata = {"apiLevel": "2.15"}

def announced(function):
    @functools.wraps(function)
    def wrapper(ctx):
        ctx.comment("announced")
        return function(ctx)
    return wrapper

@guard
@announced
@guard
def run(ctx):
    ctx.comment("ran")
"""
        lines = simulated(text)
        assert lines[1:3] == ["announced", "ran"]
        assert len(of_guard(lines)) == 1

    def test_the_public_face(self):
        assert set(aegis_ot.__all__) == {"check", "guard", "__version__"}


@pytest.mark.parametrize("form", ["decorator", "call"])
@pytest.mark.parametrize("level", ["2.11", "2.16"])
class TestSimulated:
    def test_a_good_protocol_runs_and_says_so_once(self, form, level):
        lines = simulated(protocol(GOOD, form=form, level=level))
        assert len(of_guard(lines)) == 1
        assert "Layer 1: pass" in of_guard(lines)[0]
        assert sum("Aspirating" in line for line in lines) == 2

    def test_a_bad_one_is_rejected_with_rule_wells_and_lines(self, form, level):
        text = protocol(BAD, 'assay="pcr"', form, level)
        with pytest.raises(Exception, match="PCR-2") as caught:
            simulated(text)
        told = str(caught.value)
        line = next(n for n, s in enumerate(text.splitlines(), 1) if "dispense(40, ntc)" in s)
        assert "H12" in told
        assert str(line) in told

    def test_warn_lets_it_run(self, form, level):
        lines = simulated(protocol(BAD, 'assay="pcr", rules="warn"', form, level))
        assert "PCR-2" in of_guard(lines)[-1]

    def test_off_is_silent(self, form, level):
        lines = simulated(protocol(BAD, 'assay="pcr", rules="off"', form, level))
        assert of_guard(lines) == []

    def test_its_own_error_stays_its_own(self, form, level):
        text = protocol('plate["Z9"]', form=form, level=level)
        line = len(text.splitlines())
        with pytest.raises(Exception, match="Z9") as caught:
            simulated(text)
        assert f"line {line}" in str(caught.value)
        assert "aegis" not in str(caught.value).split("errorInfo")[0]

    def test_a_wrong_setting_is_named_when_it_runs(self, form, level):
        with pytest.raises(Exception, match="hold") as caught:
            simulated(protocol(GOOD, 'hold="sometimes"', form, level))
        assert "boundary" in str(caught.value)

    def test_keyframes_reach_the_sidecar_when_simulation_is_watched(self, form, level):
        with stub_sidecar() as (url, keyframes):
            settings = f'sidecar="{url}", watch_simulation=True'
            lines = simulated(protocol(GOOD, settings, form, level))
        kinds = [keyframe["kind"] for keyframe in keyframes]
        assert kinds == ["aspirate", "transit", "dispense", "post_dispense"] * 2
        assert "2 passed" in of_guard(lines)[0]

    def test_an_analysis_contacts_nobody(self, form, level):
        with stub_sidecar() as (url, keyframes):
            simulated(protocol(GOOD, f'sidecar="{url}"', form, level))
        assert keyframes == []


@pytest.mark.parametrize("form", ["decorator", "call"])
class TestLive:
    def test_a_bad_protocol_moves_nothing(self, form):
        run = LiveRun(protocol(BAD, 'assay="pcr"', form)).start()
        run.play()
        run.join()
        assert run.status == "failed"
        moved = {c.commandType for c in run.commands}
        assert moved <= {"home", "loadLabware", "loadPipette", "comment"}
        # As the App shows it: the line of the finding, and no error of ours behind it.
        assert re.search(r"ProtocolRejected \[line \d+\]: Layer 1 found", run.told)
        assert "KeyError" not in run.told

    def test_a_stop_is_told_as_one_and_not_as_an_error(self, form):
        with FakeSidecar() as sidecar:
            sidecar.outcomes[0] = None
            run = LiveRun(protocol(GOOD, f'sidecar="{sidecar.url}", run_id="run"', form)).start()
            assert sidecar.asked.wait(60)
            run.stop()
            run.join()
            (told,) = sidecar.finished
            assert (told["outcome"], told["detail"]) == ("stopped", "")
            assert (told["trajectories"], told["keyframes"]) == (1, len(sidecar.stored()))

    def test_an_error_of_the_protocol_is_told_to_the_sidecar(self, form):
        with FakeSidecar() as sidecar:
            settings = f'sidecar="{sidecar.url}", run_id="run"'
            run = LiveRun(
                protocol("if not protocol.is_simulating(): raise ValueError('no')", settings, form)
            ).start()
            run.play()
            run.join()
            (finished,) = sidecar.finished
        assert finished["outcome"] == "failed"
        assert "RuntimeError" not in finished["detail"]
        assert ("ValueError: no" if form == "decorator" else "run log") in finished["detail"]

    def test_a_good_one_runs_rehearsed_and_watched(self, form):
        with stub_sidecar() as (url, keyframes):
            run = LiveRun(protocol(GOOD, f'sidecar="{url}"', form)).start()
            run.play()
            run.join()
        assert run.status == "succeeded"
        assert len(keyframes) == 8

    @pytest.mark.parametrize("level", ["2.15", "2.24"])
    def test_analysis_and_live_show_the_same_command_types(self, form, level):
        from aegis_ot.adapters.opentrons.rehearsal import Script, play

        with stub_sidecar() as (url, _):
            text = protocol(GOOD, f'sidecar="{url}"', form, level)
            run = LiveRun(text).start()
            run.play()
            run.join()
        live = [c.commandType for c in run.commands]
        analysed = []

        def keep(function):
            def wrapped(context):
                function(context)
                state = context._core._engine_client.state
                analysed.extend(c.commandType for c in state.commands.get_all())

            return wrapped

        play(Script(text, "live.py"), keep)
        assert [c for c in live if c != "home"] == [c for c in analysed if c != "home"]

    def test_module_state_is_not_touched_by_the_rehearsal(self, form):
        body = """
        global COUNT
        COUNT += 1
        if COUNT != 1:
            raise RuntimeError(f"rehearsed into my own module: {COUNT}")
        """
        text = protocol(GOOD + textwrap.dedent(body), form=form) + "\nCOUNT = 0\n"
        run = LiveRun(text).start()
        run.play()
        run.join()
        assert run.status == "succeeded"

    def test_a_protocol_that_swallows_the_abort_goes_no_further(self, form):
        body = """
        p300.pick_up_tip()
        for well in plate.wells()[:3]:
            try:
                p300.transfer(50, tubes["A1"], well, new_tip="never")
            except Exception:
                protocol.comment("never mind")
        """
        with FakeSidecar() as sidecar:
            sidecar.outcomes[0] = "fail"
            settings = f'sidecar="{sidecar.url}", run_id="run", on_fail="abort"'
            run = LiveRun(protocol(body, settings, form)).start().join()
            assert len(sidecar.stored()) == 4
            assert [finished["outcome"] for finished in sidecar.finished] == ["aborted"]
        assert run.status == "failed"
        assert [c.commandType for c in run.commands].count("aspirate") == 1

    def test_a_stop_during_the_rehearsal_ends_it(self, form):
        body = """
        import os
        if protocol.is_simulating():
            os.environ["AEGIS_TEST_REHEARSING"] = "1"
            while True:
                pass
        """
        os.environ.pop("AEGIS_TEST_REHEARSING", None)
        run = LiveRun(protocol(body, form=form)).start()
        in_time(lambda: "AEGIS_TEST_REHEARSING" in os.environ)
        run.stop()
        run.join()
        assert run.status == "stopped"


CAUGHT = {
    "around the call": """
def run(protocol):
    try:
        protocol = guard(protocol, {settings})
    except Exception:
        pass
{body}
""",
    "around the call, and nothing done": """
def run(protocol):
    try:
        guard(protocol, {settings})
{nested}
    except Exception:
        pass
""",
    "outside the decorated": """
@guard({settings})
def guarded(protocol):
{body}

def run(protocol):
    try:
        guarded(protocol)
    except Exception:
        pass
    protocol.home()
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", 6)
    protocol.loaded_instruments["left"].pick_up_tip(tips["A1"])
""",
    "outside the decorated, and nothing done": """
@guard({settings})
def guarded(protocol):
{body}

def run(protocol):
    try:
        guarded(protocol)
    except Exception:
        pass
""",
}


def caught(how: str, settings: str, level: str = "2.15", body: str = BAD) -> str:
    """The text of a protocol that catches what the guard raises."""
    head = f'from aegis_ot import guard\nmetadata = {{"apiLevel": "{level}"}}\n'
    setup = DECK + textwrap.dedent(body)
    return head + CAUGHT[how].format(
        settings=settings,
        body=textwrap.indent(setup, "    "),
        nested=textwrap.indent(setup, " " * 8),
    )


_STAND_INS = {
    "partial": "import functools\nrun = guard(functools.partial(_run, None), {settings})\n",
    "lambda": "run = guard(lambda protocol: _run(None, protocol), {settings})\n",
    "object": "class Runs:\n    def __call__(self, protocol): _run(None, protocol)\n"
    "run = guard(Runs(), {settings})\n",
    "helper's decorator": "import helper\n@guard({settings})\n@helper.announced\n"
    "def run(protocol): _run(None, protocol)\n",
    "helper's guard": "import helper\ndef run(protocol):\n"
    "    helper.guarded(protocol, {settings})\n    _run(None, protocol)\n",
}
_HELPER = """
from aegis_ot import guard

def announced(function):
    def wrapper(protocol):
        return function(protocol)
    return wrapper

def guarded(protocol, **settings):
    return guard(protocol, **settings)
"""


@pytest.mark.parametrize("kind", _STAND_INS)
class TestWhateverRunIs:
    """A ``run`` that does not lead back to its text is judged by the same text."""

    @pytest.fixture(autouse=True)
    def helper(self, tmp_path, monkeypatch):
        (tmp_path / "helper.py").write_text(_HELPER)
        monkeypatch.syspath_prepend(tmp_path)
        yield
        sys.modules.pop("helper", None)

    def text(self, kind, body, settings=""):
        plain = protocol(body).replace("@guard()\n", "").replace("run(p", "_run(_, p")
        unused = "def run(protocol): ...\n" if "def run" not in _STAND_INS[kind] else ""
        return plain + unused + _STAND_INS[kind].format(settings=settings)

    def test_a_bad_protocol_is_rejected_with_wells_and_lines(self, kind):
        text = self.text(kind, BAD)
        line = text[: text.index("p300.dispense(40, ntc)")].count("\n") + 1
        with pytest.raises(Exception, match=rf"PCR-2.*H12 of plate.* at line {line}\."):
            simulated(text)

    def test_a_good_one_is_watched_to_its_end(self, kind):
        with stub_sidecar() as (url, keyframes):
            lines = simulated(self.text(kind, GOOD, f'sidecar="{url}", watch_simulation=True'))
        assert "Layer 2 watched 2 deliveries: 2 passed" in of_guard(lines)[-1]
        assert len(keyframes) == 8


@pytest.mark.parametrize("how", CAUGHT)
class TestARejectionThatIsCaught:
    @pytest.mark.parametrize("level", ["2.11", "2.16"])
    def test_fails_the_analysis_all_the_same(self, how, level):
        with pytest.raises(Exception, match="PCR-2"):
            simulated(caught(how, 'assay="pcr"', level))

    def test_moves_nothing_live(self, how):
        run = LiveRun(caught(how, 'assay="pcr"')).start()
        run.play()
        run.join()
        assert run.status == "failed"
        moved = {c.commandType for c in run.commands}
        assert moved <= {"home", "loadLabware", "loadPipette", "comment"}
        assert [c.commandType for c in run.commands].count("home") <= 1  # the engine's own

    def test_a_wrong_setting_is_no_way_around_the_guard(self, how):
        run = LiveRun(caught(how, 'asay="pcr"', body=GOOD)).start()
        run.play()
        run.join()
        assert run.status == "failed"
        assert "aspirate" not in {c.commandType for c in run.commands}


@pytest.mark.parametrize("caught_by", ["except Exception:", "except:", "except BaseException:"])
@pytest.mark.parametrize("form", ["decorator", "call"])
class TestEndlessRetries:
    BODY = """
    p300.pick_up_tip()
    def retried(well):
        while True:
            try:
                p300.transfer(50, tubes["A1"], well, new_tip="never")
                return
            {caught_by}
                continue
    for well in plate.wells()[:3]:
        retried(well)
    """

    def test_an_abort_ends_them_live(self, form, caught_by):
        with FakeSidecar() as sidecar:
            sidecar.outcomes[0] = "fail"
            settings = f'sidecar="{sidecar.url}", run_id="run", on_fail="abort"'
            text = protocol(self.BODY.format(caught_by=caught_by), settings, form)
            run = LiveRun(text).start()
            run.join(60)
            assert [finished["outcome"] for finished in sidecar.finished] == ["aborted"]
        assert run.status == "failed"
        assert [c.commandType for c in run.commands].count("aspirate") == 1

    def test_an_abort_ends_them_in_a_watched_simulation(self, form, caught_by):
        with FakeSidecar() as sidecar:
            sidecar.outcomes[0] = "fail"
            settings = f'sidecar="{sidecar.url}", run_id="run", on_fail="abort"'
            settings += ", watch_simulation=True"
            body = self.BODY.format(caught_by=caught_by)
            with pytest.raises(Exception, match="The run ends here"):
                simulated(protocol(body, settings, form, "2.11"))
            assert len(sidecar.stored()) == 4


def test_nothing_stays_behind_in_the_thread_of_an_aborted_run():
    with FakeSidecar() as sidecar:
        sidecar.outcomes[0] = "fail"
        settings = f'sidecar="{sidecar.url}", on_fail="abort", watch_simulation=True'
        body = TestEndlessRetries.BODY.format(caught_by="except:")
        before = sys.gettrace(), sys.getprofile()
        with pytest.raises(Exception, match="The run ends here"):
            simulated(protocol(body, settings, "call", "2.11"))
        assert (sys.gettrace(), sys.getprofile()) == before


def test_a_protocol_after_one_that_could_not_begin_is_guarded():
    # As on a robot server, whose worker threads are used again.
    def both():
        settings = f'sidecar="http://127.0.0.1:{free_port()}", watch_simulation=True'
        settings += ', on_link_loss="abort", capture_timeout_s=0.2'
        with pytest.raises(Exception, match="cannot be reached"):
            simulated(protocol(GOOD, settings, "call", "2.11"))
        return simulated(protocol(GOOD, level="2.11"))

    assert "Layer 1: pass" in of_guard(contextvars.Context().run(both))[0]


def test_runtime_parameters_say_where_the_controls_are():
    text = WITH_PARAMETERS.replace("def run", "from aegis_ot import guard\n@guard\ndef run")
    with pytest.raises(Exception, match=r"CELL-1.*control well A12"):
        simulated(text)
