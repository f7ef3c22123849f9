"""Nothing begins unjudged, no guard ends unheard, no setting is dropped unread."""

from __future__ import annotations

import cProfile
import gc
import sys
import weakref

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.guarded_run import is_guarded
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


def patience(body: str) -> str:
    """What never ends is given up soon; all else has the time that a busy machine takes."""
    return f"rehearsal_timeout_s={1 if body is ENDLESS else 60}"


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
            settings = f'rules="{rules}", {patience(body)}, sidecar="{sidecar.url}"'
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
            settings = f'rules="warn", {patience(body)}, sidecar="{sidecar.url}"'
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


def last_of(told: list[str]) -> str:
    return told[-1]


class TestTopLevel:
    def test_it_says_at_once_what_it_covers(self, capfd):
        told = in_cells(SETUP.format(settings=""), STEPS)
        assert "covers what follows in this cell only" in told[0]
        assert "with guard(protocol):" in told[0], "what serves calls into other cells"
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


AROUND = (
    SETUP.format(settings="{settings}")
    .replace("protocol = guard(protocol, ", "keywords = dict(")
    .replace("from aegis_ot", "from contextlib import ExitStack\nfrom aegis_ot")
)
HELPER = "def fill(well):\n    p300.transfer(50, plate['A1'], plate[well])\n"
BLOCK = "with guard(protocol, **keywords):\n    fill('B3')\n    fill('B4')\n"


def watched_in_cells(*cells: str) -> tuple[list[str], list[dict], int]:
    """The guard's words, how its runs ended, and how many keyframes it sent."""
    with FakeSidecar() as sidecar:
        settings = f', sidecar="{sidecar.url}", watch_simulation=True'
        told = in_cells(AROUND.format(settings=settings), HELPER, *cells)
        return told, sidecar.finished, sum(map(len, sidecar.keyframes.values()))


class TestBlock:
    """``with guard(protocol):`` guards what the block does, wherever that was written."""

    def test_it_covers_calls_into_other_cells_and_ends_with_the_block(self):
        told, finished, keyframes = watched_in_cells(BLOCK, "fill('B5')")
        assert [one["outcome"] for one in finished] == ["succeeded"]
        assert keyframes == 8, "four a delivery; the last one is not guarded"
        assert "the `with` block does" in told[0]
        assert "Layer 2 watched 2 deliveries: 2 passed" in told[-1]
        assert not any("cell" in line for line in told)

    def test_the_robot_does_the_same_with_it_and_without(self):
        def moves(*cells: str) -> list[str]:
            names: dict = {"__name__": "__main__"}
            for number, cell in enumerate((AROUND.format(settings=""), HELPER, *cells)):
                exec(compile(cell, f"<ipython-input-{number}>", "exec"), names)
            return [line for line in names["protocol"].commands() if "aegis_ot" not in line]

        block = "with guard(protocol, **keywords) as same:\n    assert same is protocol\n"
        assert moves(block + "    fill('B3')\n") == moves("fill('B3')")

    def test_an_exception_leaves_the_block_as_it_is_and_the_run_is_no_success(self):
        block = BLOCK + "    raise KeyError('mine')"
        with FakeSidecar() as sidecar:
            settings = f', sidecar="{sidecar.url}", watch_simulation=True'
            with pytest.raises(KeyError, match="mine"):
                in_cells(AROUND.format(settings=settings), HELPER, block)
            (finished,) = sidecar.finished
        assert (finished["outcome"], finished["detail"]) == ("failed", "KeyError: 'mine'")

    def test_an_error_of_layer_1_comes_out_of_the_block(self):
        block = "with guard(protocol, **keywords):\n    " + OVERFULL
        with pytest.raises(Exception, match="GEN-3"):
            in_cells(AROUND.format(settings=', on_fail="abort"'), block)

    def test_a_second_one_inside_changes_nothing_and_ends_nothing(self):
        inner = BLOCK.replace("fill('B3')", "with guard(protocol):\n        fill('B3')")
        told, finished, _ = watched_in_cells(inner)
        assert [one["outcome"] for one in finished] == ["succeeded"]
        assert "watched 2 deliveries" in told[-1]

    def test_blocks_after_one_another_are_runs_of_their_own(self):
        _, finished, _ = watched_in_cells(BLOCK, BLOCK)
        assert [one["outcome"] for one in finished] == ["succeeded"] * 2

    def test_an_exit_stack_carries_it_over_cells(self):
        first = "guarded = ExitStack()\nguarded.enter_context(guard(protocol, **keywords))\n"
        told, finished, _ = watched_in_cells(first, "fill('B3')", "fill('B4')", "guarded.close()")
        assert [one["outcome"] for one in finished] == ["succeeded"]
        assert "until its `with` block or stack is closed" in told[1]
        assert "watched 2 deliveries: 2 passed" in told[-1]

    def test_a_set_up_cell_that_runs_again_holds_the_guard_that_goes_on(self):
        first = "guarded = ExitStack()\nguarded.enter_context(guard(protocol, **keywords))\n"
        told, finished, _ = watched_in_cells(
            first, first, "fill('B3')\nguarded.close()", "fill('B4')"
        )
        assert [one["outcome"] for one in finished] == ["succeeded"]
        assert "the earlier guard goes on" in told[2]
        assert "watched 1 deliveries: 1 passed" in told[-1]

    def test_a_with_inside_such_a_stack_does_not_end_it(self):
        first = "guarded = ExitStack()\nguarded.enter_context(guard(protocol, **keywords))\n"
        told, finished, _ = watched_in_cells(first, BLOCK, "fill('B5')\nguarded.close()")
        assert [one["outcome"] for one in finished] == ["succeeded"]
        assert "watched 3 deliveries" in told[-1]

    def test_no_hook_outlives_its_block(self):
        """Hundreds of blocks in one cell, too: their hooks would stand on one another."""
        before = sys.gettrace(), sys.getprofile()
        names: dict = {"seen": [], "sys": sys, "__name__": "__main__"}
        block = (
            "for _ in range(3):\n    with guard(protocol, **keywords):\n"
            "        seen.append((sys.gettrace(), sys.getprofile()))\n"
        )
        exec(compile(AROUND.format(settings="") + block, "<ipython-input-0>", "exec"), names)
        assert names["seen"] == [before] * 3
        assert (sys.gettrace(), sys.getprofile()) == before

    def test_a_profile_of_all_goes_on_behind_the_guard(self):
        with cProfile.Profile() as profile:
            told = in_cells(SETUP.format(settings="") + STEPS)
            assert "judged as it ran: 0 errors" in last_of(told)
        assert last_of.__code__ in [one.code for one in profile.getstats()]

    def test_guards_of_two_contexts_end_with_their_cell_and_leave_no_hook(self):
        before = sys.gettrace(), sys.getprofile()
        cell = SETUP.format(settings="")
        names: dict = {"__name__": "__main__"}
        cell = cell + "first = protocol\n" + cell
        exec(compile(cell, "<ipython-input-0>", "exec"), names)
        assert not is_guarded(names["first"])
        assert not is_guarded(names["protocol"])
        assert (sys.gettrace(), sys.getprofile()) == before

    @pytest.mark.parametrize("cell", [SETUP, AROUND + "with guard(protocol):\n    pass\n"])
    def test_a_context_whose_guard_has_ended_is_let_go(self, cell):
        names: dict = {"__name__": "__main__"}
        exec(compile(cell.format(settings=""), "<ipython-input-0>", "exec"), names)
        context = weakref.ref(names["protocol"])
        names.clear()
        gc.collect()
        assert context() is None

    def test_a_guard_that_has_ended_with_its_cell_is_not_taken_up_again(self):
        with pytest.raises(ConfigurationError, match="has ended with its cell"):
            in_cells(SETUP.format(settings="") + STEPS, "with protocol:\n    pass\n")

    def test_a_context_without_a_guard_goes_into_no_with(self):
        used = "with guard(protocol, **keywords):\n    " + STEPS
        with pytest.raises(TypeError, match="without a guard"):
            in_cells(AROUND.format(settings=""), used, "with protocol:\n    pass\n")

    def test_in_a_run_the_guard_lasts_as_long_as_the_function(self):
        body = "with guard(protocol{}):\n    " + GOOD + "\n" + GOOD
        with FakeSidecar() as sidecar:
            settings = f', sidecar="{sidecar.url}", watch_simulation=True'
            text = protocol(body.format(settings), "", "call")
            lines = simulated(text.replace("protocol = guard(protocol, )", "pass"))
            assert [one["outcome"] for one in sidecar.finished] == ["succeeded"]
        assert "Layer 2 watched 4 deliveries" in of_guard(lines)[-1]
