"""``aegis-ot install`` with an ssh that runs on this machine what it should run on the robot."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path

import pytest

from aegis_ot.errors import RobotError
from aegis_ot.robot.installing import install
from aegis_ot.robot.wheel import write_wheel

SSH = """#!/bin/sh
while [ "$1" != "root@127.0.0.1" ]; do
    echo "$1" >> "$HOME/options"
    shift
done
echo "$2" >> "$HOME/commands"
exec sh -c "$2"
"""


@pytest.fixture
def home(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A robot's home; its login shell knows a Python whose pip installs into a folder of it."""
    tools = tmp_path / "tools"
    tools.mkdir()
    for name, text in (("ssh", SSH), ("systemctl", '#!/bin/sh\necho "$@" > "$HOME/restarted"\n')):
        (tools / name).write_text(text, encoding="utf-8")
        (tools / name).chmod(0o755)
    (tools / "python3").symlink_to(sys.executable)
    (tmp_path / ".profile").write_text(
        f"export PATH={tools}:$PATH PYTHONPATH={tmp_path}/user-packages\n"
        f"export PIP_TARGET={tmp_path}/user-packages PYTHONHOME= \nunset PYTHONHOME\n",
        encoding="utf-8",
    )
    python = f'#!/bin/sh\nexec {sys.executable} "$@"\n'
    (tools / "python3").unlink()
    (tools / "python3").write_text(python, encoding="utf-8")
    (tools / "python3").chmod(0o755)
    monkeypatch.setenv("HOME", str(tmp_path))
    monkeypatch.setenv("PATH", f"{tools}:/usr/bin:/bin")
    return tmp_path


@pytest.mark.slow
def test_it_is_copied_installed_tried_and_taken_up(home: Path) -> None:
    told: list[str] = []
    found = install("127.0.0.1", Path("my key"), told=told.append)
    assert found.size < 600_000
    assert found.opentrons.split(".")[0].isdigit()
    assert "my key" in (home / "options").read_text(encoding="utf-8")
    assert (home / "restarted").read_text().strip() == "restart opentrons-robot-server"
    assert (home / "user-packages" / "aegis_ot" / "guard.py").exists()
    assert not list(Path("/tmp").glob("aegis_ot-*.whl"))
    assert len(told) == 4


def test_a_robot_that_lets_nobody_in_says_what_to_do(home: Path) -> None:
    (home / "tools" / "ssh").write_text(
        "#!/bin/sh\necho 'Permission denied (publickey).' >&2\nexit 255\n", encoding="utf-8"
    )
    with pytest.raises(RobotError, match=r"Permission denied.*public key"):
        install("127.0.0.1")


def test_a_disk_that_is_read_only_is_told_with_the_way_out(home: Path) -> None:
    (home / "tools" / "python3").write_text(
        "#!/bin/sh\necho 'OSError: [Errno 30] Read-only file system' >&2\nexit 1\n",
        encoding="utf-8",
    )
    with pytest.raises(RobotError, match="remount,rw"):
        install("127.0.0.1")


def test_the_wheel_is_pure_and_complete(tmp_path: Path) -> None:
    wheel = write_wheel(tmp_path)
    with zipfile.ZipFile(wheel) as files:
        names = files.namelist()
        metadata = next(name for name in names if name.endswith("METADATA"))
        assert "Requires-Dist" not in files.read(metadata).decode()
        files.extractall(tmp_path / "site")
    assert all(name.endswith((".py", ".json", "METADATA", "WHEEL", "RECORD")) for name in names)
    assert not any(name.startswith(("aegis_ot/sidecar", "aegis_ot/vision")) for name in names)
    tried = (
        "import aegis_ot.guarded_run, aegis_ot.preflight.checking as c; print(c.load_database())"
    )
    subprocess.run([sys.executable, "-c", tried], cwd=tmp_path / "site", check=True,
                   capture_output=True, env={"PYTHONPATH": str(tmp_path / "site")})  # fmt: skip
