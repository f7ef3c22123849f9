"""What is planted is done by the robot, and heard by nobody above."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

from aegis_ot import guard
from aegis_ot.adapters.opentrons.instrumentation import Operation, OperationKind, tapped
from aegis_ot.adapters.opentrons.rehearsal import Recorder, Script, play, record
from aegis_ot.dryrun import DryRunSettings, dry_run
from aegis_ot.planted import KINDS
from aegis_ot.preflight.check_protocol import check_recording, errors_of
from aegis_ot.qualification.plan import QualificationPlan, QualifyingDelivery
from aegis_ot.qualification.protocol import GUARD, protocol_text
from aegis_ot.robot.wrapping import wrap
from aegis_ot.settings import load_settings

from ..sidecar.helpers import StubAnalyser

KINDS_AND_SHARES = {
    "normal": 0.0, "left": 0.25, "nothing": 0.0, "air": 0.1, "more": 0.25, "no_tip": 0.0,
}  # fmt: skip
ROBOTS = {
    "p300_single_gen2": "opentrons_96_tiprack_300ul",
    "flex_1channel_1000": "opentrons_flex_96_tiprack_1000ul",
}


def plan_of(pipette: str) -> QualificationPlan:
    """Each kind once, and all that is left at last."""
    whats = [*KINDS_AND_SHARES.items(), ("left", 1.0)]
    deliveries = tuple(
        QualifyingDelivery("dye", f"{row}1", 1, kind, share)
        for row, (kind, share) in zip("ABCDEFG", whats, strict=True)
    )
    return QualificationPlan(1, pipette, "right", ROBOTS[pipette], 100.0, deliveries)


def commands_of(text: str, around: Any = lambda run: run) -> list[Any]:
    """What the engine was told to do."""
    kept: list[Any] = []
    play(Script(text, "qualification.py"), lambda run: keeping(around(run), kept))
    return kept


def keeping(run: Any, kept: list[Any]) -> Any:
    """A run that adds what the engine was told to do to ``kept``."""

    def watched(protocol: Any) -> None:
        run(protocol)
        kept.extend(protocol._core._engine_client.state.commands.get_all())

    return watched


def by_tip(commands: list[Any]) -> list[list[Any]]:
    """The commands from each tip to the next."""
    tips: list[list[Any]] = []
    for command in commands:
        if command.commandType == "pickUpTip":
            tips.append([])
        elif tips and command.commandType != "comment":
            tips[-1].append(command)
    return tips


def strokes(commands: list[Any]) -> list[tuple[str, float]]:
    return [
        (each.commandType, round(each.params.volume, 3))
        for each in commands
        if each.commandType in ("aspirate", "dispense")
    ]


@pytest.fixture(scope="module", params=ROBOTS)
def tips(request: pytest.FixtureRequest) -> dict[str, list[Any]]:
    plan = plan_of(request.param)
    found = by_tip(commands_of(protocol_text(plan)))
    assert len(found) == len(plan.deliveries)
    return dict(zip([*KINDS_AND_SHARES, "all left"], found, strict=True))


def test_every_kind_is_tried_here() -> None:
    assert set(KINDS_AND_SHARES) == set(KINDS)


def test_the_plunger_moves_as_planned(tips: dict[str, list[Any]]) -> None:
    whole = [("aspirate", 100.0), ("dispense", 100.0)]
    assert strokes(tips["normal"]) == whole
    assert strokes(tips["left"]) == [("aspirate", 100.0), ("dispense", 75.0)]
    assert strokes(tips["all left"]) == [("aspirate", 100.0)]
    assert strokes(tips["nothing"]) == strokes(tips["no_tip"]) == []
    assert strokes(tips["more"]) == [("aspirate", 125.0), ("dispense", 100.0)]
    drawn = strokes(tips["air"])
    assert [volume for _, volume in drawn] == pytest.approx([58.5, 10.0, 31.5, 100.0])


def test_air_is_drawn_over_the_liquid(tips: dict[str, list[Any]]) -> None:
    heights = [
        each.params.wellLocation.offset.z for each in tips["air"] if each.commandType == "aspirate"
    ]
    assert heights[1] > 0 > heights[0] == heights[2]


def test_what_is_left_goes_into_its_own_well_and_the_tip_into_the_trash(
    tips: dict[str, list[Any]],
) -> None:
    for kind, commands in tips.items():
        emptied = [each.params.wellName for each in commands if each.commandType == "blowout"]
        well = {"left": "B1", "more": "E1", "all left": "G1"}.get(kind)
        assert emptied == ([well] if well else [])
        assert [each.commandType for each in commands].count("dropTipInPlace") == 1


def test_a_bare_nozzle_stays_as_high_as_with_its_tip(tips: dict[str, list[Any]]) -> None:
    commands = tips["no_tip"]
    dropped = [each.commandType for each in commands].index("dropTipInPlace")
    moves = [each for each in commands[dropped:] if each.commandType == "moveToWell"]
    assert len(moves) >= 2
    for move in moves:
        # No well here is as deep as the shortest tip is long.
        assert move.params.wellLocation.offset.z > 25


@pytest.mark.parametrize("pipette", ROBOTS)
def test_layer_1_hears_of_plain_deliveries(pipette: str) -> None:
    plan = plan_of(pipette)
    recording = record(Script(protocol_text(plan), "qualification.py"))
    drawn = [
        (each.kind, each.volume)
        for each in recording.log
        if isinstance(each, Operation)
        and each.kind in (OperationKind.ASPIRATE, OperationKind.DISPENSE)
    ]
    one = [(OperationKind.ASPIRATE, 100.0), (OperationKind.DISPENSE, 100.0)]
    assert drawn == one * len(plan.deliveries)
    assert not errors_of(check_recording(recording, load_settings()))


def test_nothing_puts_right_what_was_planted(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AEGIS_OT_RECOVER", '{"no_aspirate": "retry"}')
    monkeypatch.setenv("AEGIS_OT_ON_FAIL", "abort")
    assert load_settings().recover
    settings = load_settings(**GUARD)
    assert (settings.recover, settings.on_fail) == ({}, "continue")


def test_the_guard_hears_of_plain_deliveries_while_the_robot_fails() -> None:
    """What listens above ``planted`` hears what the protocol wrote."""
    plan = plan_of("p300_single_gen2")
    text = (
        protocol_text(plan)
        .replace("@guard(", "@listening(", 1)
        .replace(
            "from aegis_ot import guard", "from tests.qualification.test_planted import listening"
        )
    )
    HEARD.clear()
    commands = commands_of(text)
    volumes = [each.volume for each in HEARD if each.kind is OperationKind.DISPENSE]
    assert volumes == [100.0] * len(plan.deliveries)
    assert sum(stroke == ("dispense", 100.0) for stroke in strokes(commands)) == 3


AS_WRITTEN: dict[str, Callable[[str], str]] = {
    "plain": lambda text: text, "wrapped": lambda text: wrap(text).text,
}  # fmt: skip
"""A wrapped protocol carries a copy of this package, unknown to the one that tries it."""


@pytest.mark.parametrize("written", AS_WRITTEN)
def test_nothing_is_planted_under_a_guard_from_outside(written: str) -> None:
    plan = plan_of("p300_single_gen2")
    others = GUARD | {"on_fail": "pause", "rules": "off"}
    text = AS_WRITTEN[written](protocol_text(plan))
    commands = commands_of(text, lambda run: guard(run, **others))
    assert strokes(commands) == [("aspirate", 100.0), ("dispense", 100.0)] * len(plan.deliveries)


@pytest.mark.parametrize("written", AS_WRITTEN)
def test_nothing_is_planted_in_a_rehearsal(written: str) -> None:
    plan = plan_of("p300_single_gen2")
    kept: list[Any] = []
    record(
        Script(AS_WRITTEN[written](protocol_text(plan)), "qualification.py"),
        look=lambda context: kept.extend(context._core._engine_client.state.commands.get_all()),
    )
    assert strokes(kept) == [("aspirate", 100.0), ("dispense", 100.0)] * len(plan.deliveries)


@pytest.mark.parametrize("written", AS_WRITTEN)
def test_nothing_is_planted_in_a_dry_run(written: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Of the whole of ``aegis-ot simulate``, with a sidecar and a guard that watches."""
    plan = plan_of("p300_single_gen2")
    kept: list[Any] = []

    def play_and_keep(script: Script, wrap_run: Any) -> None:
        play(script, lambda run: keeping(wrap_run(run), kept))

    monkeypatch.setattr("aegis_ot.dryrun.runner.play", play_and_keep)
    script = Script(AS_WRITTEN[written](protocol_text(plan)), "qualification.py")
    done = dry_run(script, DryRunSettings(), StubAnalyser())
    assert (done.outcome, len(done.wells)) == ("succeeded", len(plan.deliveries))
    assert strokes(kept) == [("aspirate", 100.0), ("dispense", 100.0)] * len(plan.deliveries)


HEARD: list[Operation] = []


def listening(**_settings: Any) -> Any:
    """Stands where the guard stands."""

    def decorate(run: Any) -> Any:
        def heard(protocol: Any) -> None:
            recorder = Recorder()
            with tapped(protocol, [recorder], "qualification.py"):
                run(protocol)
            HEARD.extend(each for each in recorder.log if isinstance(each, Operation))

        return heard

    return decorate


def test_a_wrapped_protocol_brings_what_plants_along() -> None:
    text = protocol_text(plan_of("p300_single_gen2"))
    wrapped = wrap(text)
    plain = wrap("from aegis_ot import guard\n\n@guard\ndef run(protocol):\n    pass\n")
    assert wrapped.bundle.modules == plain.bundle.modules + 1
    assert strokes(by_tip(commands_of(wrapped.text))[1]) == [
        ("aspirate", 100.0),
        ("dispense", 75.0),
    ]
