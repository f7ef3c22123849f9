from __future__ import annotations

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.llm import ScriptedBackend, TokenUsage, hybrid
from aegis_ot.llm.layer1_prompt import hybrid_request

from .samples import CONTAMINATED, answer, check_with_dossier, examined, rule_set


def test_hybrid_keeps_and_counts() -> None:
    report, dossier, reading = examined(CONTAMINATED)
    backend = ScriptedBackend([answer()], TokenUsage(10, 20, 30, 40))
    result = hybrid(report, dossier, reading, backend)
    assert result.report.findings == report.findings
    assert result.usage == TokenUsage(10, 20, 30, 40)
    assert result.reply is not None
    assert result.reply.model == "scripted"


def test_a_laboratorys_own_rules_are_told(tmp_path) -> None:  # type: ignore[no-untyped-def]
    import json

    from aegis_ot.preflight import load_rules
    from aegis_ot.preflight.rule_set import shipped_rules

    family = json.loads((shipped_rules() / "generic.json").read_text())
    rule = next(r for r in family["rules"] if r["id"] == "GEN-1")
    own = family | {
        "family": "ours",
        "default": False,
        "rules": [
            rule
            | {
                "id": "LAB-7",
                "statement": "Never pipette on a Friday.",
                "prompt": "Is it a Friday?",
                "indicators": ["a weekday in the metadata"],
            }
        ],
    }
    (tmp_path / "ours.json").write_text(json.dumps(own))
    rule_set_ = load_rules([tmp_path])
    _, dossier, _ = check_with_dossier(Script(CONTAMINATED, "p.py"), rule_set_)
    # The sidecar knows the shipped rules only; the dossier carries the others.
    request = hybrid_request(dossier, rule_set())
    said = str(request.messages[0].parts[0])
    for told in ("Never pipette on a Friday.", "Is it a Friday?", "a weekday in the metadata"):
        assert told in said
