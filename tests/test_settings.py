from __future__ import annotations

import json
import subprocess
import sys
from dataclasses import fields
from pathlib import Path

import pytest

from aegis_ot import settings as module
from aegis_ot.errors import ConfigurationError
from aegis_ot.settings import Settings, load_settings
from aegis_ot.settings.sources import PREFIX
from aegis_ot.settings.values import READERS


@pytest.fixture(autouse=True)
def _empty_home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for name in [*module.NAMES, "config"]:
        monkeypatch.delenv(PREFIX + name.upper(), raising=False)
    monkeypatch.setenv("HOME", str(tmp_path / "home"))


def write(path: Path, text: str) -> Path:
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text)
    return path


def test_defaults_are_layer_one_alone() -> None:
    settings = load_settings()
    assert settings == Settings()
    assert settings.sidecar is None
    assert (settings.on_fail, settings.on_undecided, settings.on_link_loss) == ("pause",) * 3


def test_argument_over_environment_over_file_over_default(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = write(tmp_path / "f.json", json.dumps({"hold": "well", "assay": "pcr", "lift": False}))
    monkeypatch.setenv("AEGIS_OT_CONFIG", str(path))
    monkeypatch.setenv("AEGIS_OT_ASSAY", "bradford")
    monkeypatch.setenv("AEGIS_OT_HOLD", "off")
    settings = load_settings(hold="boundary")
    assert (settings.hold, settings.assay, settings.lift) == ("boundary", "bradford", False)
    assert settings.rules == "on"


def test_every_field_has_a_reader() -> None:
    assert set(READERS) == {f.name for f in fields(Settings)}


@pytest.mark.parametrize(
    ("name", "text", "value"),
    [
        ("sidecar", "http://192.168.1.20:7645/", "http://192.168.1.20:7645"),
        ("sidecar", "none", None),
        ("select", "PCR-2, GEN-3", ("PCR-2", "GEN-3")),
        ("roles", '{"ntc": ["plate:H12"]}', {"ntc": ("plate:H12",)}),
        ("recover", '{"no_aspirate": "retry", "no_dispense": "pause"}', {"no_aspirate": "retry"}),
        ("recover_limit", "3", 3),
        ("watch_simulation", "yes", True),
        ("lift", "0", False),
        ("verdict_timeout_s", "2.5", 2.5),
        ("on_fail", "Abort", "abort"),
    ],
)
def test_environment_texts(
    name: str, text: str, value: object, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv(PREFIX + name.upper(), text)
    assert getattr(load_settings(), name) == value


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("rules", "of"),
        ("hold", 3),
        ("on_fail", "stop"),
        ("sidecar", "192.168.1.20:7645"),
        ("sidecar", "ftp://host"),
        ("sidecar", "http://host:99999"),
        ("sidecar", 7645),
        ("token", "two words"),
        ("token", ""),
        ("select", [1]),
        ("roles", ["ntc"]),
        ("roles", {"ntc": 5}),
        ("lift", "perhaps"),
        ("lift", None),
        ("capture_timeout_s", 0),
        ("capture_timeout_s", "soon"),
        ("capture_timeout_s", True),
        ("verdict_timeout_s", float("nan")),
        ("run_id", "a/b"),
        ("recover", {"partial_dispense": "retry"}),
        ("recover", {"no_tip": "retry"}),
        ("recover", "retry"),
        ("recover_limit", -1),
        ("assay", 5),
    ],
)
def test_bad_values_name_the_setting_its_origin_and_what_is_accepted(
    name: str, value: object
) -> None:
    with pytest.raises(ConfigurationError) as caught:
        load_settings(**{name: value})
    assert f"{name!r} (argument)" in str(caught.value)
    assert "Accepted:" in str(caught.value)


def test_a_close_choice_is_suggested() -> None:
    with pytest.raises(ConfigurationError, match="did you mean 'continue'"):
        load_settings(on_fail="contineu")


def test_a_token_is_never_shown() -> None:
    with pytest.raises(ConfigurationError) as caught:
        load_settings(token="se cret")
    assert "cret" not in str(caught.value)
    assert "s3cret" not in repr(load_settings(token="s3cret"))
    with pytest.raises(ConfigurationError) as caught:
        load_settings(sidecar="http://me:s3cret@robot:7645")
    assert "s3cret" not in str(caught.value)


@pytest.mark.parametrize("address", ["http://h/pä", "http://h:1/a b", "http://a\x00b:1"])
def test_an_address_that_http_cannot_carry(address: str) -> None:
    with pytest.raises(ConfigurationError, match="sidecar"):
        load_settings(sidecar=address)


def test_an_address_without_its_scheme_is_completed() -> None:
    with pytest.raises(ConfigurationError, match=r'did you mean "http://192\.168\.1\.20:7645"'):
        load_settings(sidecar="192.168.1.20:7645")


def test_simulated_frames_are_not_a_setting() -> None:
    with pytest.raises(ConfigurationError, match=r"`aegis-ot simulate PROTOCOL\.py`"):
        load_settings(sidecar="simulated")


def test_a_long_value_is_shown_in_short() -> None:
    with pytest.raises(ConfigurationError) as caught:
        load_settings(hold="x" * 10_000)
    assert len(str(caught.value)) < 300


def test_a_mistyped_variable_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AEGIS_OT_ON_FIAL", "abort")
    with pytest.raises(ConfigurationError, match=r"AEGIS_OT_ON_FIAL.*Did you mean 'on_fail'"):
        load_settings()


def test_variables_of_others_are_left_alone(monkeypatch: pytest.MonkeyPatch) -> None:
    for name in ("SIDECAR_TOKEN", "SIDECAR_PORT", "MODEL", "MODEL_RECORD", "PRICES", "LLM_API_KEY"):
        monkeypatch.setenv(PREFIX + name, "x")
    assert load_settings() == Settings()


def test_bad_environment_value_names_the_variable(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("AEGIS_OT_HOLD", "never")
    with pytest.raises(ConfigurationError, match="AEGIS_OT_HOLD"):
        load_settings()


@pytest.mark.parametrize(
    ("given", "suggested"), [("on_fial", "on_fail"), ("sidecars", "sidecar"), ("asay", "assay")]
)
def test_an_unknown_name_gets_a_suggestion(given: str, suggested: str) -> None:
    with pytest.raises(ConfigurationError, match=f"'{given}'.*Did you mean '{suggested}'"):
        load_settings(**{given: 1})


def test_a_name_like_no_other_gets_the_list() -> None:
    with pytest.raises(ConfigurationError, match="Settings are: assay, rules"):
        load_settings(zzz=1)


class TestFile:
    def test_found_in_the_home_directory(self, tmp_path: Path) -> None:
        write(tmp_path / "home/.config/aegis-ot/guard.json", '{"assay": "pcr"}')
        assert load_settings().assay == "pcr"

    @pytest.mark.skipif(sys.version_info < (3, 11), reason="tomllib")
    def test_toml(self, tmp_path: Path) -> None:
        write(
            tmp_path / "home/.config/aegis-ot/guard.toml",
            'select = ["PCR-2"]\n[roles]\nntc = ["plate:H12"]\n',
        )
        settings = load_settings()
        assert settings.select == ("PCR-2",)
        assert settings.roles == {"ntc": ("plate:H12",)}

    def test_toml_where_python_cannot_read_it(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        path = write(tmp_path / "g.toml", "")
        monkeypatch.setenv("AEGIS_OT_CONFIG", str(path))
        monkeypatch.setitem(sys.modules, "tomllib", None)
        with pytest.raises(ConfigurationError, match="as JSON"):
            load_settings()

    @pytest.mark.parametrize("text", ["{", "[1]", '{"hold": "x"}', '{"nothing": 1}'])
    def test_bad_content_names_the_file(
        self, text: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        path = write(tmp_path / "g.json", text)
        monkeypatch.setenv("AEGIS_OT_CONFIG", str(path))
        with pytest.raises(ConfigurationError, match=r"g\.json"):
            load_settings()

    def test_bytes_that_are_no_text(self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        (tmp_path / "g.json").write_bytes(b"\xff\xfe\x00")
        monkeypatch.setenv("AEGIS_OT_CONFIG", str(tmp_path / "g.json"))
        with pytest.raises(ConfigurationError, match=r"g\.json.*UTF-8"):
            load_settings()

    def test_a_mark_of_byte_order_is_no_trouble(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        (tmp_path / "g.json").write_bytes(b'\xef\xbb\xbf{"rules": "off"}')
        monkeypatch.setenv("AEGIS_OT_CONFIG", str(tmp_path / "g.json"))
        assert load_settings().rules == "off"

    def test_a_folder_that_may_not_be_read_holds_no_settings(
        self, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        def denied(*_args: object, **_kwargs: object) -> None:
            raise PermissionError(13, "Permission denied")

        monkeypatch.setattr("os.stat", denied)
        assert load_settings() == Settings()

    def test_the_home_of_nobody(self, monkeypatch: pytest.MonkeyPatch) -> None:
        monkeypatch.setenv("AEGIS_OT_CONFIG", "~no-such-user/guard.json")
        with pytest.raises(ConfigurationError, match=r"guard\.json"):
            load_settings()

    def test_a_named_file_that_is_not_there(
        self, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
    ) -> None:
        monkeypatch.setenv("AEGIS_OT_CONFIG", str(tmp_path / "missing.json"))
        with pytest.raises(ConfigurationError, match=r"missing\.json"):
            load_settings()


def test_importing_reads_nothing(tmp_path: Path) -> None:
    environment = {"HOME": str(tmp_path), "AEGIS_OT_CONFIG": str(tmp_path / "missing.json")}
    subprocess.run(
        [sys.executable, "-c", "import aegis_ot.settings"],
        check=True,
        cwd=Path(__file__).parents[1],
        env=environment,
    )


def test_run_ids_are_fresh_unless_given() -> None:
    assert Settings().new_run_id() != Settings().new_run_id()
    assert load_settings(run_id="run-7").new_run_id() == "run-7"
