"""Protocol Designer's files and analyses, judged by their commands."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

from aegis_ot.adapters.opentrons.instrumentation import EventKind, Operation, OperationKind
from aegis_ot.preflight import Script, load_rules, record
from aegis_ot.reports import renderer
from aegis_ot.workbench import CheckedProtocol, CheckSettings, Rehearser, check_files
from aegis_ot.workbench.commands import recording_of
from aegis_ot.workbench.documents import Analyse

REUSES_A_TIP = """
metadata = {"protocolName": "Samples", "apiLevel": "2.16"}
def run(protocol):
    tips = protocol.load_labware("opentrons_96_tiprack_300ul", "1")
    plate = protocol.load_labware("nest_96_wellplate_200ul_flat", "2", "samples")
    block = protocol.load_module("temperature module gen2", "3")
    adapter = block.load_adapter("opentrons_96_well_aluminum_block")
    cold = adapter.load_labware("opentrons_96_wellplate_200ul_pcr_full_skirt", "cold")
    water = protocol.define_liquid("water", "clean", "#0000ff")
    plate["A1"].load_liquid(water, 60)
    pipette = protocol.load_instrument("p300_multi_gen2", "left", [tips])
    pipette.pick_up_tip()
    pipette.aspirate(150, plate["A1"])
    pipette.air_gap(10)
    pipette.dispense(160, cold["A2"].top(-2))
    pipette.mix(2, 30, cold["A2"])
    block.set_temperature(4)
    pipette.blow_out()
    pipette.drop_tip()
    protocol.pause("new tips")
"""


def designers(commands: list[dict[str, Any]], schema: int = 8) -> dict[str, Any]:
    """What Protocol Designer writes, as far as the engine reads it."""
    return {
        "$otSharedSchema": f"#/protocol/schemas/{schema}",
        "schemaVersion": schema,
        "metadata": {"protocolName": "Drawn", "created": 1},
        "robot": {"model": "OT-2 Standard", "deckId": "ot2_standard"},
        "designerApplication": {"name": "opentrons/protocol-designer", "version": "8.0.0"},
        "liquidSchemaId": "opentronsLiquidSchemaV1",
        "liquids": {"0": {"displayName": "water", "description": "", "displayColor": "#00f"}},
        "labwareDefinitionSchemaId": "opentronsLabwareSchemaV2",
        "labwareDefinitions": DEFINITIONS,
        "commandSchemaId": "opentronsCommandSchemaV8",
        "commands": commands,
        "commandAnnotationSchemaId": "opentronsCommandAnnotationSchemaV1",
        "commandAnnotations": [],
    }


def _definition(name: str) -> dict[str, Any]:
    from opentrons_shared_data.labware import load_definition

    return dict(load_definition(name, 1))


RACK, PLATE = "opentrons_96_tiprack_300ul", "nest_96_wellplate_200ul_flat"
DEFINITIONS = {f"opentrons/{name}/1": _definition(name) for name in (RACK, PLATE)}


def drawn() -> list[dict[str, Any]]:
    """One tip takes more from a well than is in it."""

    def load(name: str, slot: str, key: str) -> dict[str, Any]:
        params = {"loadName": name, "namespace": "opentrons", "version": 1, "labwareId": key,
                  "displayName": key, "location": {"slotName": slot}}  # fmt: skip
        return {"commandType": "loadLabware", "key": key, "params": params}

    def do(kind: str, labware: str, well: str, origin: str = "bottom", **more: Any) -> dict:
        where = {"origin": origin, "offset": {"x": 0, "y": 0, "z": 1 if origin == "bottom" else 0}}
        params = {"pipetteId": "p", "labwareId": labware, "wellName": well, "wellLocation": where}
        return {"commandType": kind, "key": kind + well, "params": params | more}

    flow = {"volume": 100, "flowRate": 50}
    pipette = {"pipetteName": "p300_single_gen2", "mount": "left", "pipetteId": "p"}
    trash = {"pipetteId": "p", "addressableAreaName": "fixedTrash"}
    liquid = {"labwareId": "plate", "liquidId": "0", "volumeByWell": {"A1": 40}}
    return [
        {"commandType": "loadPipette", "key": "p", "params": pipette},
        load(RACK, "1", "rack"),
        load(PLATE, "2", "plate"),
        {"commandType": "loadLiquid", "key": "l", "params": liquid},
        do("pickUpTip", "rack", "A1", "top"),
        do("aspirate", "plate", "A1", **flow),
        do("dispense", "plate", "B1", **flow),
        {"commandType": "moveToAddressableAreaForDropTip", "key": "m", "params": trash},
        {"commandType": "dropTipInPlace", "key": "d", "params": {"pipetteId": "p"}},
    ]


def checked(file: Path, content: Any) -> CheckedProtocol:
    file.write_text(content if isinstance(content, str) else json.dumps(content))
    return check_files([file], CheckSettings(), load_rules()).protocols[0]


@pytest.fixture(scope="module")
def analysed() -> tuple[dict[str, Any], dict[str, Any]]:
    """Analyses of the Python protocol, and of Protocol Designer's."""
    with Rehearser() as rehearser:
        python = rehearser.perform(Analyse(REUSES_A_TIP, "samples.py", 60))
        return python, rehearser.perform(Analyse(json.dumps(designers(drawn())), "d.json", 60))


def test_commands_tell_what_a_rehearsal_hears(analysed: Any) -> None:
    document = analysed[0]
    recording, lines = recording_of(document, "samples.json")
    heard = record(Script(REUSES_A_TIP, "samples.py"))

    def told(log: Any) -> list[Any]:
        return [
            (o.kind, [w and (w.slot, w.name, w.label) for w in o.wells], o.volume, o.disposal,
             o.mixing, o.from_bottom and round(o.from_bottom, 3), o.is_air)
            if isinstance(o, Operation)
            else (o.kind, o.text, [w.name for w in o.wells], o.volume)
            for o in log if o.kind is not EventKind.LABWARE_LOADED
        ]  # fmt: skip

    expected = [
        # An air gap of this apiLevel is an aspirate above the well.
        (OperationKind.ASPIRATE, *one[1:]) if one[0] is OperationKind.AIR_GAP else one
        for one in told(heard.log)
    ]
    assert told(recording.log) == expected
    names = {info.load_name for info in heard.labware.values() if not info.is_trash}
    assert {info.load_name for info in recording.labware.values()} == names
    assert len(lines) == len(document["commands"])
    assert "aspirate 150 µL: A1 of samples (slot 2) and 7 more" in lines


def test_a_designers_file_is_run_by_opentrons_and_cites_its_commands(tmp_path: Path) -> None:
    file = tmp_path / "drawn.json"
    file.write_text(json.dumps(designers(drawn())))
    run = check_files([file], CheckSettings(), load_rules())
    (judged,) = run.protocols
    assert judged.report is not None, judged.problem
    assert any(note.startswith("run by Opentrons' engine") for note in judged.notes)
    finding = next(one for one in judged.findings if one.lines)
    assert judged.lines[finding.lines[-1] - 1].startswith("aspirate 100 µL: A1 of plate")
    number = finding.lines[-1]
    assert f"drawn.json, command {number}" in renderer("text")(run)
    assert json.loads(renderer("json")(run))["protocols"][0]["lines_are"] == "commands"
    assert f"line={number}" not in renderer("github")(run)
    assert '"startLine"' not in renderer("sarif")(run)


ANNOTATED = [
    {"annotationType": "secondOrderCommand", "machineReadableName": "pause", "params": {},
     "commandKeys": ["l"]},
    {"annotationType": "secondOrderCommand", "machineReadableName": "transfer", "params": {},
     "userSpecifiedName": "add water", "commandKeys": ["aspirateA1", "dispenseB1", "none"]},
]  # fmt: skip


@pytest.mark.parametrize(("of_designer", "told"), [(2, "step 2 (add water)"), (5, 'step "add wa')])
def test_findings_cite_the_steps_that_a_designers_file_tells(
    tmp_path: Path, of_designer: int, told: str
) -> None:
    file = tmp_path / "drawn.json"
    document = designers(drawn()) | {"commandAnnotations": ANNOTATED}
    # Designer's own groups may hold several steps: their numbers are then none of Designer's.
    document["designerApplication"]["data"] = {"orderedStepIds": [*map(str, range(of_designer))]}
    file.write_text(json.dumps(document))
    run = check_files([file], CheckSettings(), load_rules())
    (judged,) = run.protocols
    number = next(one for one in judged.findings if one.lines).lines[-1]
    assert f"drawn.json, {told}" in renderer("text")(run)
    assert f", command {number}" in renderer("text")(run)
    for name in ("github", "sarif", "line", "html", "junit"):
        assert "add water" in renderer(name)(run)
    (finding,) = json.loads(renderer("json")(run))["protocols"][0]["findings"]
    step = {"name": "add water", "number": 2 if of_designer == 2 else None}
    assert finding["steps"] == [step]


def test_groups_of_an_analysis_are_steps(analysed: Any, tmp_path: Path) -> None:
    commands = [{**one, "commandAnnotationIds": ["g"]} for one in analysed[1]["commands"]]
    document = analysed[1] | {
        "commands": commands,
        "commandAnnotations": [{"id": "g", "source": "user", "name": "Dilute", "params": {}}],
    }
    judged = checked(tmp_path / "analysis.json", document)
    assert judged.report is not None, judged.problem
    assert set(map(str, judged.steps.values())) == {"step 1 (Dilute)"}


def test_an_analysis_needs_no_engine(
    analysed: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    document = analysed[0]
    monkeypatch.setenv("AEGIS_OT_ENGINES", str(tmp_path))
    monkeypatch.setattr("aegis_ot.workbench.engines.here", lambda: None)
    for content in (document, {"data": document}):
        judged = checked(tmp_path / "analysis.json", content)
        assert judged.report is not None, judged.problem
        assert judged.unit == "command"


def test_a_rack_whose_tips_are_gone_was_replaced(analysed: Any) -> None:
    steps = analysed[1]["commands"]
    tip = next(n for n, one in enumerate(steps) if one["commandType"] == "pickUpTip")
    document = analysed[1] | {"commands": [*steps, *steps[tip:]]}
    recording, _ = recording_of(document, "drawn.json")
    resets = [one for one in recording.log if one.kind is EventKind.TIPS_RESET]
    assert [one.line for one in resets] == [len(steps) + 1]


@pytest.mark.parametrize(
    ("content", "told"),
    [
        ("{", "is no JSON"),
        ({"parameters": {"loadName": "plate"}, "wells": {}}, "neither of Protocol Designer nor an"),
        (designers([], 5), "old Protocol Designer (schema 5)"),
        ({"commands": [{"commandType": "aspirate", "params": {"pipetteId": "p"}}]},
         "its commands cannot be read"),
        ({"commands": [], "result": "not-ok", "errors": [{"detail": "no tip"}]},
         "Opentrons' analysis of it failed: no tip"),
        (designers([{"commandType": "home", "params": 3}]), "Opentrons"),
    ],
)  # fmt: skip
def test_what_cannot_be_judged_says_why(tmp_path: Path, content: Any, told: str) -> None:
    judged = checked(tmp_path / "odd.json", content)
    assert judged.problem is not None
    assert told in judged.problem.message
    assert not judged.problem.bug
