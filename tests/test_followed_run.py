"""A live run that does otherwise than its rehearsal never keeps the rehearsal's verdict."""

from __future__ import annotations

import re

import pytest

from tests.runtime.fake_sidecar import FakeSidecar
from tests.runtime.live import LiveRun
from tests.test_guard import GOOD, of_guard, protocol

SHUFFLED = """
import random
wells = plate.wells()[:8] if protocol.is_simulating() else plate.wells()[7::-1]
p300.transfer(50, tubes["A1"], wells, new_tip="always")
"""
SHARES_A_TIP = """
template, water, ntc = tubes["A1"], tubes["A2"], plate["H12"]
p300.pick_up_tip()
p300.aspirate(40, template)
p300.dispense(40, plate["A1"])
if protocol.is_simulating():
    p300.drop_tip()
    p300.pick_up_tip()
p300.aspirate(40, water)
p300.dispense(40, ntc)
p300.drop_tip()
"""
NOTHING_REHEARSED = """
if protocol.is_simulating():
    return
p300.transfer(50, tubes["A1"], plate.wells()[:2], new_tip="always")
"""
ENDS_EARLIER = """
wells = plate.wells()[:3 if protocol.is_simulating() else 2]
p300.transfer(50, tubes["A1"], wells, new_tip="always")
"""
TOUCHES = """
p300.transfer(40, tubes["A1"], plate["A1"])
p300.pick_up_tip()
p300.aspirate(40, tubes["A2"])
well = plate["A1"]
p300.dispense(40, well.{rehearsed} if protocol.is_simulating() else well.bottom(1))
p300.drop_tip()
"""


def comments(run: LiveRun) -> list[str]:
    said = [c.params.message for c in run.commands if c.commandType == "comment"]
    return of_guard([str(text) for text in said])


def moved(run: LiveRun) -> list[str]:
    return [c.commandType for c in run.commands if c.commandType in ("aspirate", "dispense")]


def played(text: str, pauses: int = 0) -> LiveRun:
    """The run, after an operator resumed it so many times."""
    run = LiveRun(text).start()
    run.play()
    for _ in range(pauses):
        run.wait_for_status("paused", 30)
        run.play()
    return run.join()


@pytest.mark.parametrize("form", ["decorator", "call"])
class TestOtherwise:
    @pytest.mark.parametrize(
        ("body", "how"),
        [
            (SHUFFLED, r"dispenses 50 µL into H1 of plate .*rehearsal .* into A1 of plate"),
            (NOTHING_REHEARSED, r"picks up a tip at line \d+, where the rehearsal moved nothing"),
            (ENDS_EARLIER, r"it ended where in the rehearsal the left pipette picks up a tip"),
            (
                TOUCHES.format(rehearsed="top(5)"),
                r"A1 of plate .*, 1 mm above its bottom, at line \d+, where .* 5 mm above its top,",
            ),
            (TOUCHES.format(rehearsed="top(-1)"), r"above its bottom, at .* mm above its bottom,"),
        ],
    )
    def test_it_says_so_at_the_end_and_no_pass(self, form, body, how):
        run = played(protocol(body, 'assay="generic"', form))
        assert run.status == "succeeded"
        (said,) = comments(run)
        assert re.search(how, said)
        assert said.startswith("aegis_ot: Layer 1: not as rehearsed.")
        assert "judged as it ran: 0 errors" in said
        assert "Layer 1: pass" not in said

    def test_an_error_pauses_before_it_is_done(self, form):
        run = LiveRun(protocol(SHARES_A_TIP, 'assay="pcr", rules="strict"', form)).start()
        run.play()
        run.wait_for_status("paused", 30)
        before = [c.commandType for c in run.seen()]
        assert before.count("dispense") == 1
        (pause,) = [c for c in run.seen() if c.commandType == "waitForResume"]
        assert re.search(r"otherwise than its rehearsal.*PCR-2.*H12", pause.params.message)
        run.play()
        run.join()
        assert moved(run) == ["aspirate", "dispense"] * 2
        assert re.search(r"not as rehearsed\..* 2 errors,", comments(run)[-1])

    def test_abort_ends_it(self, form):
        settings = 'assay="pcr", on_fail="abort"'
        run = LiveRun(protocol(SHARES_A_TIP, settings, form)).start()
        run.play()
        run.join()
        assert run.status == "failed"
        assert "PCR-2" in run.told
        assert moved(run)[:2] == ["aspirate", "dispense"]
        assert moved(run).count("dispense") == 1


@pytest.mark.parametrize("form", ["decorator", "call"])
@pytest.mark.parametrize(
    "body",
    [
        GOOD,
        "for n in range(3 if protocol.is_simulating() else 1): protocol.delay(0.01)\n" + GOOD,
        # The next tip is another one.
        "if not protocol.is_simulating(): p300.starting_tip = tips['C5']\n" + GOOD,
        # Mixed for as long as something takes.
        "p300.pick_up_tip()\np300.aspirate(50, tubes['A1'])\np300.dispense(50, plate['A1'])\n"
        "p300.mix(2 if protocol.is_simulating() else 5, 40, plate['A1'])\np300.drop_tip()",
        # At another height, and slower.
        "p300.pick_up_tip()\nz = 2 if protocol.is_simulating() else 3\n"
        "p300.aspirate(50, tubes['A1'].bottom(z), rate=z)\np300.dispense(50, plate['A1'])\n"
        "p300.drop_tip()",
    ],
)
def test_what_may_differ_is_no_difference(form, body):
    run = played(protocol(body, 'assay="generic", rules="strict"', form))
    assert run.status == "succeeded"
    assert re.search(r"Layer 1: (pass|warn)", comments(run)[-1])
    assert "waitForResume" not in {c.commandType for c in run.commands}


@pytest.mark.parametrize("form", ["decorator", "call"])
def test_the_sidecar_hears_of_it_at_once_and_in_the_end(form):
    with FakeSidecar() as sidecar:
        settings = f'assay="generic", sidecar="{sidecar.url}", run_id="run"'
        run = played(protocol(SHUFFLED, settings, form))
        assert run.status == "succeeded"
        (told,) = sidecar.incidents
        kinds = [path.rsplit("/", 1)[-1] for _, path, _ in sidecar.requests]
        (finished,) = sidecar.finished
    assert told["kind"] == "layer1"
    assert "into H1 of plate" in told["text"]
    assert kinds.index("incident") < kinds.index("finish") - 8
    assert finished["layer1"]["verdict"] == "not as rehearsed"
    assert "judged as it ran" in finished["layer1"]["note"]


def test_what_the_guard_does_itself_is_no_difference():
    with FakeSidecar() as sidecar:
        sidecar.outcomes[0] = "fail"
        sidecar.findings[0] = {
            "failure": "no_aspirate",
            "gate": "volumetric",
            "measured_ul": 0.0,
        }
        settings = (
            f'assay="generic", sidecar="{sidecar.url}", run_id="run", '
            'recover={"no_aspirate": "retry"}'
        )
        run = played(protocol(GOOD, settings))
        assert [one["state"] for one in sidecar.recoveries] == ["begun", "recovered"]
    assert run.status == "succeeded"
    assert "Layer 1: pass" in comments(run)[-1]


def test_what_came_before_the_guard_belongs_to_neither():
    text = protocol(GOOD, 'assay="generic"', "call")
    call = re.search(r".*guard\(protocol.*\n", text)[0]
    first = '    p300.transfer(20, tubes["A2"], plate["H1"])\n'
    text = (
        text.replace(call, "")
        .rstrip("\n")
        .replace("    p300.transfer(50", f"{first}{call}    p300.transfer(50")
    )
    run = played(text)
    assert run.status == "succeeded"
    assert "Layer 1: pass" in comments(run)[-1]


def test_an_error_pauses_a_watched_run_where_its_page_can_answer():
    with FakeSidecar() as sidecar:
        settings = f'assay="pcr", sidecar="{sidecar.url}", run_id="run"'
        run = LiveRun(protocol(SHARES_A_TIP, settings)).start()
        run.play()
        run.wait_for_status("paused", 30)
        asked = [one for one in sidecar.holds if one["resolution"] == "layer1"]
        assert [one["policy"] for one in asked] == ["pause"]
        run.play()
        run.join()
        last = [one for one in sidecar.holds if one["resolution"] == "layer1"][-1]
    assert run.status == "succeeded"
    assert last["answered"] == "robot"


USED_AGAIN = """
for n in range(3):
    p300.pick_up_tip(tips.wells()[n if protocol.is_simulating() else 0])
    p300.transfer(20, tubes.wells()[n], plate.wells()[n], new_tip="never")
    p300.return_tip()
"""


@pytest.mark.parametrize("form", ["decorator", "call"])
def test_a_tip_that_was_on_before_is_not_a_fresh_one(form):
    run = played(protocol(USED_AGAIN, 'assay="generic", rules="warn"', form))
    assert run.status == "succeeded"
    how = r"picks up again the tip of its pick-up 1 at line \d+, where .* picks up a tip"
    assert re.search(rf"Layer 1: not as rehearsed\..*{how}", comments(run)[-1])


@pytest.mark.parametrize(
    "body",
    [
        # Each sample has a tip of its own, which is used again; the first one is another.
        "first = 0 if protocol.is_simulating() else 5\n"
        "for n in (0, 1, 0, 1):\n"
        "    p300.pick_up_tip(tips.wells()[first + n])\n"
        "    p300.transfer(20, tubes.wells()[n], plate.wells()[n], new_tip='never')\n"
        "    p300.return_tip()",
        # The rack is filled at another moment.
        "for n in range(3):\n"
        "    if n == (2 if protocol.is_simulating() else 1): p300.reset_tipracks()\n"
        "    p300.transfer(20, tubes.wells()[0], plate.wells()[n], trash=False)",
    ],
)
def test_which_tip_of_those_that_are_fresh_is_no_difference(body):
    run = played(protocol(body, 'assay="generic", rules="warn"'))
    assert run.status == "succeeded"
    assert "Layer 1: not as rehearsed" not in comments(run)[-1]


def test_each_of_several_guards_is_held_against_its_own_part_of_the_rehearsal():
    text = protocol(
        "for column, turned in zip(plate.columns(), (False, False, True)):\n"
        "    wells = column[:2]\n"
        "    if turned and not protocol.is_simulating(): wells.reverse()\n"
        "    part(protocol, p300, tubes['A1'], wells)"
    ).replace(
        "@guard()\n",
        "@guard(assay='generic', rules='warn')\n"
        "def part(protocol, p300, source, wells):\n"
        "    p300.transfer(50, source, wells, new_tip='always')\n\n",
    )
    run = played(text)
    assert run.status == "succeeded"
    last = [said for said in comments(run) if "undecided" in said][1::2]
    assert [said.startswith("aegis_ot: Layer 1: not as rehearsed.") for said in last] == [
        False, False, True,
    ]  # fmt: skip
    assert "into B3 of plate" in last[-1]


def test_a_rehearsal_leaves_chance_as_it_was():
    """What a protocol draws from a seed of its own is what it draws without a guard."""
    body = "wells = plate.wells()\nrandom.shuffle(wells)\n"
    body += "p300.transfer(50, tubes['A1'], wells[:3], new_tip='always')"
    seeded = protocol(body, 'assay="generic"').replace(
        "metadata", "import random\nrandom.seed(7)\nmetadata", 1
    )
    unguarded = played(seeded.replace('@guard(assay="generic")\n', ""))
    run = played(seeded)
    filled = [
        [c.params.wellName for c in one.commands if c.commandType == "dispense"]
        for one in (unguarded, run)
    ]
    assert filled[0] == filled[1]
    assert "Layer 1: pass" in comments(run)[-1]
