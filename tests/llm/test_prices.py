from __future__ import annotations

import json
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.llm import TokenUsage, load_prices

MILLION = TokenUsage(1_000_000, 1_000_000, 1_000_000, 1_000_000)


def test_the_table_is_dated_and_prices_every_kind_of_token() -> None:
    table = load_prices()
    assert len(table.as_of) == 10
    assert table.cost("claude-opus-4-7", MILLION) == pytest.approx(5 + 0.5 + 6.25 + 25)
    assert table.cost("gpt-4o", TokenUsage(1_000_000, 1_000_000)) == pytest.approx(2.5 + 1.25)


def test_dated_names_count_and_other_models_do_not() -> None:
    table = load_prices()
    assert table.price("claude-sonnet-4-5-20250929") == table.price("claude-sonnet-4-5")
    assert table.price("gpt-4o-mini-2024-07-18") == table.price("gpt-4o-mini")
    assert table.price("openai/gpt-4o-2024-08-06") == table.price("gpt-4o")
    assert table.price("gpt-4o-audio-preview") is None
    assert table.cost("some-local-model", MILLION) is None


def test_the_users_prices_win(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    path = tmp_path / "prices.json"
    own = {"as_of": "2027-01-01", "models": {"gpt-4o": {"input": 1, "output": 2}}}
    path.write_text(json.dumps(own))
    monkeypatch.setenv("AEGIS_OT_PRICES", str(path))
    table = load_prices()
    assert table.as_of == "2027-01-01"
    assert table.cost("gpt-4o", MILLION) == pytest.approx(1 + 1 + 1 + 2)
    assert table.price("claude-opus-4-7") is not None


@pytest.mark.parametrize(
    "text",
    ["{", "[]", '{"as_of": "x"}', '{"as_of": "x", "models": {"m": {"input": -1, "output": 1}}}'],
)
def test_a_bad_table_is_named(tmp_path: Path, text: str) -> None:
    path = tmp_path / "prices.json"
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=r"prices\.json"):
        load_prices(path)
