"""A run is opened with its own plan, and with no other."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest

from aegis_ot.adapters.opentrons.rehearsal import Script, play, record
from aegis_ot.errors import ConfigurationError
from aegis_ot.qualification.certificate import count_liquid
from aegis_ot.qualification.opening import open_plan
from aegis_ot.qualification.plan import QualificationPlan, QualifyingDelivery
from aegis_ot.qualification.protocol import protocol_text
from aegis_ot.robot.wrapping import wrap
from aegis_ot.run_view.plain_protocol import plan_of as rehearsed_plan
from aegis_ot.sidecar import SidecarConfig, running_sidecar
from aegis_ot.sidecar.store import Store
from aegis_ot.sidecar.store.opening import open_store

from ..sidecar.helpers import StubAnalyser, StubCamera

TIPS = {"p300_single": "opentrons_96_tiprack_300ul"}


def plan_of(pipette: str = "p300_single", seed: int = 1) -> QualificationPlan:
    tips = TIPS.get(pipette, "opentrons_flex_96_tiprack_1000ul")
    deliveries = (
        QualifyingDelivery("dye", "A1"),
        QualifyingDelivery("dye", "B1"),
        QualifyingDelivery("dye", "C1", 1, "left", 0.5),
    )
    return QualificationPlan(seed, pipette, "right", tips, 100.0, deliveries)


def run_of(
    plan: QualificationPlan, folder: Path, judge: StubAnalyser | None = None, wrapped: bool = False
) -> Store:
    """A store with one run of it, ``"q"``."""
    config = SidecarConfig(port=0, data=folder)
    with running_sidecar(config, StubCamera(), judge or StubAnalyser([2])) as url:
        settings: dict[str, Any] = {"sidecar": url, "run_id": "q", "watch_simulation": True}
        text = protocol_text(plan, settings)
        play(Script(wrap(text).text if wrapped else text, "qualification.py"), lambda run: run)
    return open_store(folder)


@pytest.mark.parametrize("pipette", ["flex_1channel_1000", "p300_single"])
def test_a_pipette_is_known_by_any_of_its_names(pipette: str, tmp_path: Path) -> None:
    plan = plan_of(pipette)
    delivered, _ = open_plan(run_of(plan, tmp_path), "q", plan)
    assert [each.outcome for each in delivered] == ["pass", "pass", "fail"]


def test_nothing_is_planted_in_the_rehearsal_of_a_wrapped_protocol() -> None:
    text = protocol_text(plan_of())
    told, wrapped = (rehearsed_plan(record(Script(t, "q.py"))) for t in (text, wrap(text).text))
    assert told == wrapped
    assert [one.wells for one in told[0]] == [["3:A1"], ["3:B1"], ["3:C1"]]


def test_another_seed_is_another_plan_though_its_wells_are_the_same(tmp_path: Path) -> None:
    plan = plan_of()
    store = run_of(plan, tmp_path, wrapped=True)
    with pytest.raises(ConfigurationError, match=r"no run of this plan.*Name the file"):
        open_plan(store, "q", plan_of(seed=2))
    assert len(open_plan(store, "q", plan)[0]) == 3


def test_a_first_well_that_a_gate_fails_is_a_flagged_normal(tmp_path: Path) -> None:
    plan = plan_of()
    store = run_of(plan, tmp_path, StubAnalyser([1], unsure=[0]))
    counted = count_liquid("dye", open_plan(store, "q", plan)[0], plan)
    assert (counted["first_asked"]["hits"], counted["first_asked"]["of"]) == (1, 3)
    assert (counted["normals_flagged"]["hits"], counted["normals_flagged"]["of"]) == (1, 1)
