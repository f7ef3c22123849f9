"""The description of the sidecar is whole, and nothing that fits it, or not, makes it fail."""

from __future__ import annotations

import httpx
import pytest

schemathesis = pytest.importorskip("schemathesis")

from hypothesis import HealthCheck, Phase, given, settings  # noqa: E402
from hypothesis import strategies as st  # noqa: E402
from hypothesis.errors import Unsatisfiable  # noqa: E402

GenerationMode = schemathesis.GenerationMode

from aegis_ot.sidecar import SidecarConfig, running_sidecar  # noqa: E402
from aegis_ot.sidecar.config import CameraSettings  # noqa: E402

EXAMPLES = 15
"""Requests an operation; all of them take about 20 s."""


@pytest.fixture(scope="module")
def schema(tmp_path_factory: pytest.TempPathFactory):
    pattern = CameraSettings(spec="pattern")
    config = SidecarConfig(port=0, data=tmp_path_factory.mktemp("fuzz"), camera=pattern)
    with running_sidecar(config) as url:
        httpx.put(f"{url}/v1/runs/known", json={"run": "known"}, trust_env=False)
        yield schemathesis.openapi.from_url(f"{url}/v1/openapi.json")


@pytest.mark.parametrize("mode", list(GenerationMode), ids=lambda mode: mode.value)
def test_no_request_makes_the_sidecar_fail(schema, mode) -> None:
    operations = [found.ok() for found in schema.get_all_operations()]
    assert len(operations) >= 15
    for operation in operations:
        _fuzz(operation, mode)


def _fuzz(operation, mode) -> None:
    @given(case=operation.as_strategy(generation_mode=mode), known=st.booleans())
    @settings(
        max_examples=EXAMPLES,
        deadline=None,
        derandomize=True,
        database=None,
        phases=(Phase.explicit, Phase.generate),
        suppress_health_check=list(HealthCheck),
    )
    def ask(case, known: bool) -> None:
        if known and "run" in (case.path_parameters or {}):
            case.path_parameters["run"] = "known"
        if "wait" in (case.query or {}):
            case.query["wait"] = 0
        answer = case.call(timeout=10)
        assert answer.status_code < 500, f"{operation.label}: {answer.text}"
        if answer.status_code >= 400 and case.method != "TRACE":
            assert set(answer.json()["error"]) == {"code", "message", "hint"}

    try:
        ask()
    except Unsatisfiable:
        assert mode is GenerationMode.NEGATIVE  # nothing can be wrong with it


def test_every_reference_leads_somewhere(url: str) -> None:
    described = httpx.get(f"{url}/v1/openapi.json", trust_env=False).json()
    schemas = described["components"]["schemas"]
    text = str(described)
    for name in schemas:
        text = text.replace(f"'#/components/schemas/{name}'", "")
    assert "#/components/schemas/" not in text
    assert "#/$defs" not in text
    assert {"RunStart", "Keyframe", "Hold", "Finish", "Decision", "Action"} <= schemas.keys()
