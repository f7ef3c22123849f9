"""Settings from file, environment and arguments."""

from __future__ import annotations

import socket
import sys
from pathlib import Path

import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot.sidecar import SidecarConfig, serve

from .helpers import StubCamera


def test_arguments_win_over_the_environment_over_the_file(tmp_path: Path) -> None:
    file = tmp_path / "s.json"
    file.write_text('{"port": 1, "token": "file", "camera": {"spec": "usb:3", "timeout_s": 9}}')
    environ = {
        "AEGIS_OT_SIDECAR_PORT": "2",
        "AEGIS_OT_SIDECAR_CAMERA": "pattern",
        "AEGIS_OT_SIDECAR_NOTIFY": "json://a json://b",
    }
    config = SidecarConfig.load(file, environ, port=3, host=None)
    assert (config.port, config.camera.spec, config.camera.timeout_s) == (3, "pattern", 9.0)
    assert config.token is not None
    assert config.token.get_secret_value() == "file"
    assert len(config.notifications.urls) == 2


@pytest.mark.skipif(sys.version_info < (3, 11), reason="TOML came with Python 3.11")
def test_toml(tmp_path: Path) -> None:
    file = tmp_path / "s.toml"
    file.write_text("port = 5\n[cascade]\nband = 0.7\n")
    assert SidecarConfig.load(file, {}).cascade.band == 0.7


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("{", "damaged"),
        ("[1]", "one object"),
        ('{"prot": 1}', "prot: there is no such setting; did you mean 'port'"),
        ('{"zzz": 1}', "there are host, port"),
        ('{"port": 99999}', "port"),
        ('{"camera": {"timeout_s": NaN}}', "camera.timeout_s"),
        ('{"camera": {"speck": 1}}', "camera.speck: there is no such setting; did you mean 'spec'"),
        (
            '{"cameras": [{"robot": "a", "speck": 1}]}',
            "cameras.0.speck: there is no such setting; did you mean 'spec'",
        ),
        ('{"token": ""}', "token"),
        ('{"token": "a b"}', "token"),
        ('{"cascade": {"gates": ["oracle"]}}', "oracle"),
        ('{"cascade": {"gates": "vlm"}}', r'cascade.gates: must be a list, as \["vlm"\]'),
        ('{"cameras": 3}', "cameras: must be a list"),
        ('{"gate": {"spot_check": 0.1}}', "gate: there is no such .* mean cascade.spot_check?"),
        ('{"camera": {"spot_check": 0.1}}', "did you mean cascade.spot_check?"),
        ('{"gate": {"zzz": 1}}', "there are host, port"),
        ('{"camera": 7}', r"camera: is a section of settings: \[camera\] in TOML"),
    ],
)
def test_errors_name_what_is_wrong(tmp_path: Path, text: str, told: str) -> None:
    file = tmp_path / "s.json"
    file.write_text(text)
    with pytest.raises(ConfigurationError, match=told) as caught:
        SidecarConfig.load(file, {})
    assert "pydantic" not in str(caught.value)


def test_a_missing_file_is_told(tmp_path: Path) -> None:
    with pytest.raises(ConfigurationError, match="Cannot read"):
        SidecarConfig.load(tmp_path / "none.json", {})


def test_a_port_in_use_is_told(tmp_path: Path) -> None:
    with socket.create_server(("127.0.0.1", 0)) as taken:
        config = SidecarConfig(port=taken.getsockname()[1], data=tmp_path)
        with pytest.raises(ConfigurationError, match="Is another sidecar running"):
            serve(config, StubCamera())


def test_an_address_that_is_not_ours_is_told(tmp_path: Path) -> None:
    config = SidecarConfig.load(environ={}, host="192.0.2.1", token="t" * 16, port=0, data=tmp_path)
    with pytest.raises(ConfigurationError, match="Cannot listen"):
        serve(config, StubCamera())
