"""Nothing begins unjudged, no guard ends unheard, no setting is dropped unread."""

from __future__ import annotations

import sys

import pytest

from tests.runtime.fake_sidecar import FakeSidecar
from tests.runtime.live import LiveRun
from tests.test_followed_run import comments
from tests.test_guard import GOOD, of_guard, protocol, simulated

ENDLESS = """
while protocol.is_simulating():
    pass
"""
RAISES = """
if protocol.is_simulating():
    raise ValueError("no simulation here")
"""
MOVES = {"aspirate", "dispense", "pickUpTip", "moveToWell", "home"}


def played(text: str) -> LiveRun:
    run = LiveRun(text).start()
    run.play()
    return run.join()


@pytest.mark.parametrize("form", ["decorator", "call"])
@pytest.mark.parametrize(
    ("body", "why"),
    [
        (ENDLESS, "did not end within 1 s of rehearsal"),
        (RAISES, "ValueError: no simulation here"),
    ],
)
class TestNoRehearsal:
    @pytest.mark.parametrize("rules", ["on", "strict"])
    def test_the_run_does_not_begin(self, form, body, why, rules):
        with FakeSidecar() as sidecar:
            settings = f'rules="{rules}", rehearsal_timeout_s=1, sidecar="{sidecar.url}"'
            run = played(protocol(body + GOOD, settings, form))
            (finished,) = sidecar.finished
            start = next(b for method, _, b in sidecar.requests if method == "PUT")
        assert run.status == "failed"
        assert why in run.told
        assert "no tip has moved" in run.told
        assert 'rules=\\"warn\\"' in run.told
        assert ("rehearsal_timeout_s" in run.told) == (body is ENDLESS)
        assert not MOVES & {c.commandType for c in run.commands[1:]}  # the engine homes
        assert finished["outcome"] == "failed"
        assert why in finished["detail"]
        assert why in start["layer1"]["note"]

    def test_warn_lets_it_run_and_says_so_first(self, form, body, why):
        with FakeSidecar() as sidecar:
            settings = f'rules="warn", rehearsal_timeout_s=1, sidecar="{sidecar.url}"'
            run = played(protocol(body + GOOD, settings, form))
            start = next(b for method, _, b in sidecar.requests if method == "PUT")
            (finished,) = sidecar.finished
        assert run.status == "succeeded"
        before, after = comments(run)
        assert why in before
        kinds = [c.commandType for c in run.commands if c.commandType in {"comment", "pickUpTip"}]
        assert kinds[:3] == ["comment", "comment", "pickUpTip"]
        assert after.startswith("aegis_ot: Layer 1: not rehearsed.")
        assert "judged as it ran: 0 errors" in after
        assert why in start["layer1"]["note"]
        assert finished["layer1"]["verdict"] == "not rehearsed"


@pytest.mark.parametrize("form", ["decorator", "call"])
def test_warn_shows_an_analysis_the_same_commands(form):
    settings = 'assay="generic", rules="warn"'
    analysed = simulated(protocol(GOOD, settings, form))
    run = played(protocol(GOOD, settings, form))
    assert len(comments(run)) == len(of_guard(analysed)) == 2


class TestOneGuard:
    INNER = "protocol = guard(protocol, {})\n" + GOOD

    @pytest.mark.parametrize(
        ("inner", "told"),
        [
            ('sidecar="http://127.0.0.1:9"', "called again with sidecar"),
            ('rules="off", hold="off"', "called again with rules, hold"),
            ("sidcar=1", "no setting 'sidcar'"),
        ],
    )
    def test_other_settings_of_an_inner_one_are_refused_by_name(self, inner, told):
        with pytest.raises(Exception, match=told):
            simulated(protocol(self.INNER.format(inner)))

    def test_a_second_one_of_the_rest_likewise(self):
        body = 'protocol = guard(protocol, on_fail="abort")\n' + GOOD
        with pytest.raises(Exception, match="called again with on_fail"):
            simulated(protocol(body, form="call"))

    def test_live_it_is_refused_before_anything_moves(self):
        run = played(protocol(GOOD + '\nguard(protocol, sidecar="http://127.0.0.1:9")'))
        assert run.status == "failed"
        assert "called again with sidecar" in run.told
        assert "aspirate" not in {c.commandType for c in run.commands}

    @pytest.mark.parametrize("inner", ["", 'assay="generic"'])
    def test_the_same_again_is_fine(self, inner):
        lines = simulated(protocol(self.INNER.format(inner), 'assay="generic"'))
        assert "Layer 1: pass" in of_guard(lines)[0]


class TestProfilers:
    """A protocol that profiles itself does not lose the guard's end."""

    @pytest.mark.parametrize(
        "body",
        [
            "import sys\nsys.setprofile(None)\n" + GOOD,
            "import cProfile\nprofile = cProfile.Profile()\nprofile.enable()\n"
            + GOOD
            + "\nprofile.disable()",
            "import sys\nsys.settrace(None)\n" + GOOD,
        ],
    )
    def test_the_end_is_told(self, body):
        before = sys.gettrace(), sys.getprofile()
        with FakeSidecar() as sidecar:
            settings = f'sidecar="{sidecar.url}", watch_simulation=True'
            lines = simulated(protocol(body, settings, "call"))
            assert [one["outcome"] for one in sidecar.finished] == ["succeeded"]
        assert "Layer 2 watched 2 deliveries: 2 passed" in of_guard(lines)[-1]
        assert (sys.gettrace(), sys.getprofile()) == before


SETUP = """
import opentrons.simulate
from aegis_ot import guard
protocol = opentrons.simulate.get_protocol_api("2.15")
protocol = guard(protocol, assay="generic"{settings})
tips = protocol.load_labware("opentrons_96_tiprack_300ul", 1)
plate = protocol.load_labware("corning_96_wellplate_360ul_flat", 2)
p300 = protocol.load_instrument("p300_single_gen2", "left", tip_racks=[tips])
"""
STEPS = 'p300.transfer(50, plate["A1"], plate["B3"])\n'
OVERFULL = 'p300.transfer(500, plate["A1"], plate["A3"])\n'


def in_cells(*cells: str) -> list[str]:
    """What the guard has put into the run log of a notebook with these cells."""
    names = {"__name__": "__main__"}
    for number, cell in enumerate(cells):
        exec(compile(cell, f"<ipython-input-{number}>", "exec"), names)
    return [line for line in names["protocol"].commands() if "aegis_ot" in line]


class TestTopLevel:
    def test_it_says_at_once_what_it_covers(self, capfd):
        told = in_cells(SETUP.format(settings=""), STEPS)
        assert "covers what follows in this cell" in told[0]
        assert "this cell" in capfd.readouterr().err

    def test_a_guard_that_saw_nothing_warns_and_is_no_success(self, capfd):
        with FakeSidecar() as sidecar:
            settings = f', sidecar="{sidecar.url}", watch_simulation=True'
            told = in_cells(SETUP.format(settings=settings), STEPS)
            (finished,) = sidecar.finished
        assert "WARNING" in told[1]
        assert "saw no pipetting" in told[1]
        assert finished["outcome"] == "failed"
        assert "saw no pipetting" in finished["detail"]
        assert "WARNING" in capfd.readouterr().err

    def test_what_follows_in_its_cell_is_judged_as_it_comes(self):
        told = in_cells(SETUP.format(settings="") + STEPS)
        assert "Layer 1: not rehearsed." in told[-1]
        assert "judged as it ran: 0 errors" in told[-1]

    def test_an_error_is_told_before_it_is_done(self):
        with pytest.raises(Exception, match="GEN-3"):
            in_cells(SETUP.format(settings=', on_fail="abort"') + OVERFULL)

    def test_an_aborted_context_says_that_a_new_one_is_needed(self):
        names = {"__name__": "__main__"}
        cell = SETUP.format(settings=', on_fail="abort"') + OVERFULL
        with pytest.raises(Exception, match="GEN-3"):
            exec(compile(cell, "<ipython-input-0>", "exec"), names)
        with pytest.raises(Exception, match="a new run needs a new one"):
            exec(compile("protocol.home()", "<ipython-input-1>", "exec"), names)

    def test_pooling_is_no_error_half_way(self):
        pooled = (
            'samples = plate.columns()[0][:3]\np300.transfer(30, samples, plate["A3"])\n'
            'p300.transfer(40, plate["A3"], plate["A5"])\n'
        )
        told = in_cells(SETUP.format(settings=', on_fail="abort"') + pooled)
        assert "judged as it ran" in told[-1]
