from __future__ import annotations

import statistics
from pathlib import Path

from aegis_ot.adapters.opentrons.rehearsal import Script
from aegis_ot.llm.layer1_prompt import hybrid_request
from aegis_ot.llm.prompts_text import prompt
from aegis_ot_lab.tokens import estimate_tokens, request_size
from tests.llm.samples import check_with_dossier, rule_set

BENCHMARK = Path(__file__).parents[2] / "examples" / "benchmark"


def test_the_estimate_runs_high() -> None:
    prose = prompt("instructions")
    assert estimate_tokens(prose) >= len(prose) / 4
    code = "p20.aspirate(10, plate['A1'])\n" * 20
    assert estimate_tokens(code) >= len(code) / 3


def test_a_hybrid_request_keeps_to_its_budget() -> None:
    """Issue 4: median at most 6,000 tokens in, at least 60 % of them cached, 1,200 out.

    A quarter of the shipped benchmark; docs/reference/llm.md has the figures of all of it.
    """
    sizes = []
    for path in sorted(BENCHMARK.glob("*.py"))[::4]:
        _, dossier, _ = check_with_dossier(Script(path.read_text(), path.name), rule_set())
        request = hybrid_request(dossier, rule_set())
        assert request.max_output <= 1200
        sizes.append(request_size(request))
    assert len(sizes) == 6
    assert statistics.median(size.total for size in sizes) <= 6000
    assert statistics.median(size.cached_share for size in sizes) >= 0.6
    assert len({size.cached for size in sizes}) == 1, "one prefix serves all protocols"
