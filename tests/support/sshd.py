"""A real sshd on loopback, run by whoever runs the tests, that leads to a home like a robot's."""

from __future__ import annotations

import getpass
import os
import shutil
import socket
import subprocess
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from types import TracebackType

import opentrons
import pip
import pytest

PROFILE = """
echo "Setting OT_SYSTEM_VERSION=1.0"
export PATH="{home}/python/bin:$PATH" TMPDIR="{home}/tmp"
"""


class Robot:
    """Something like a robot behind ssh; a context manager.

    Its Python is an environment of its own that knows Opentrons' packages, and whose pip installs
    under another root, as a robot's does: the disk of the robot's own packages is read-only.

    Attributes:
        user, port: Who may log in, and where.
        no_server: A port at which nobody listens, where a robot's HTTP server would.
        key: Private key file that is let in.
        home: Home folder in there.
        packages: Where what is installed goes.
        host_key: Private key file of the server.
        tools: A folder with the machine's own ssh, that knows no host but ours and no key of yours.
        known: File with the host keys that it knows.
    """

    def __init__(self, folder: Path) -> None:
        sshd = shutil.which("sshd", path=f"{os.environ.get('PATH', '')}:/usr/sbin")
        if sshd is None:
            pytest.skip("There is no sshd here (Debian: apt-get install openssh-server).")
        self._sshd = sshd
        self._folder = folder
        self._server: subprocess.Popen[bytes] | None = None
        self.user = getpass.getuser()
        self.port, self.no_server = _free_port(), _free_port()
        self.key = _new_key(folder / "key")
        self.home = folder / "home"
        (self.home / "tmp").mkdir(parents=True)
        self.packages = _python(self.home)
        (self.home / ".profile").write_text(PROFILE.format(home=self.home), encoding="utf-8")
        (folder / "authorized").write_bytes((folder / "key.pub").read_bytes())
        self.says("systemctl", 'echo "$@" > "$HOME/systemctl"')
        self.host_key = folder / "host"
        self.known = folder / "known_hosts"
        self.tools = _ssh(folder, f"UserKnownHostsFile {self.known}")

    def says(self, program: str, script: str) -> None:
        """What a program of the robot does, as a shell script."""
        path = self.home / "python" / "bin" / program
        path.unlink(missing_ok=True)
        path.write_text(f"#!/bin/sh\n{script}\n", encoding="utf-8")
        path.chmod(0o755)

    @contextmanager
    def as_it_is(self) -> Iterator[None]:
        """Undo what its programs were told to do meanwhile."""
        programs = self.home / "python" / "bin"
        kept = self._folder / "kept"
        shutil.copytree(programs, kept, symlinks=True)
        try:
            yield
        finally:
            shutil.rmtree(programs)
            kept.rename(programs)

    def start(self) -> None:
        """Serve, under a new host key."""
        self.stop()
        config = {
            "ListenAddress": "127.0.0.1",
            "Port": self.port,
            "HostKey": _new_key(self.host_key),
            "AuthorizedKeysFile": self._folder / "authorized",
            "PermitRootLogin": "prohibit-password",
            "StrictModes": "no",
            "UsePAM": "no",
            "PidFile": "none",
            "SetEnv": f"HOME={self.home}",
        }
        path = self._folder / "sshd_config"
        path.write_text("".join(f"{name} {value}\n" for name, value in config.items()))
        if os.getuid() == 0:
            Path("/run/sshd").mkdir(mode=0o755, exist_ok=True)  # as its service would
        with (self._folder / "sshd.log").open("wb") as log:
            self._server = subprocess.Popen([self._sshd, "-D", "-e", "-f", path], stderr=log)
        until = time.monotonic() + 60.0
        while time.monotonic() < until:
            with socket.socket() as there:
                if there.connect_ex(("127.0.0.1", self.port)) == 0:
                    return
            assert self._server.poll() is None, (self._folder / "sshd.log").read_text()
            time.sleep(0.02)
        raise AssertionError("sshd does not listen")

    def stop(self) -> None:
        """Serve no longer."""
        if self._server is not None:
            self._server.kill()
            self._server.wait(60)
            self._server = None

    def __enter__(self) -> Robot:
        self.start()
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        at: TracebackType | None,
    ) -> None:
        self.stop()


def _free_port() -> int:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        port: int = taken.getsockname()[1]
        return port


def _new_key(path: Path) -> Path:
    path.unlink(missing_ok=True)
    command = ["ssh-keygen", "-q", "-t", "ed25519", "-N", "", "-f", path]
    subprocess.run(command, check=True)
    return path


def _ssh(folder: Path, known: str) -> Path:
    tools = folder / "tools"
    tools.mkdir()
    (tools / "config").write_text(f"{known}\nGlobalKnownHostsFile /dev/null\nIdentityAgent none\n")
    ssh = tools / "ssh"
    ssh.write_text(f'#!/bin/sh\nexec {shutil.which("ssh")} -F {tools}/config "$@"\n')
    ssh.chmod(0o755)
    return tools


def _python(home: Path) -> Path:
    """Make the robot's Python; the folder that its pip installs into."""
    subprocess.run(
        [sys.executable, "-m", "venv", "--without-pip", "--symlinks", home / "python"], check=True
    )
    site = next((home / "python").glob("lib/python*/site-packages"))
    root = home / "user-packages"
    packages = root / site.relative_to("/")
    ours = {str(Path(module.__file__ or "").parents[1]) for module in (opentrons, pip)}
    (site / "robot.pth").write_text("\n".join([str(packages), *ours, ""]))
    (home / "python" / "pip.conf").write_text(f"[install]\nroot = {root}\n")
    packages.mkdir(parents=True)
    return packages
