"""What a rehearsal does beyond the simulator is told, with its line."""

from __future__ import annotations

import textwrap

import pytest

from aegis_ot.workbench.reaching import reaches


@pytest.mark.parametrize(
    ("text", "told"),
    [
        ("import smtplib\ns = smtplib.SMTP('mail')", "line 2: it sends mail (smtplib.SMTP)"),
        ("from smtplib import SMTP as S\nS('mail')", "line 2: it sends mail (smtplib.SMTP)"),
        ("import socket\nx = socket.socket()", "opens a network connection (socket.socket)"),
        ("import urllib.request\nurllib.request.urlopen(u)", "opens a network connection"),
        ("import requests as r\nr.post(u)", "opens a network connection (requests.post)"),
        ("with open('log.txt', 'a') as f: f.write('x')", "line 1: it writes a file"),
        ("open(p, mode='w')", "writes a file"),
        ("p.open('w')", "writes a file"),
        ("from pathlib import Path\nPath('x').write_text('y')", "line 2: it writes a file"),
        ("table.to_csv('x.csv')", "writes a file"),
        ("import os\nos.system('beep')", "starts another program (os.system)"),
        ("if c.is_simulating():\n    open('x', 'w')", "writes a file"),
        ("if not c.is_simulating():\n    pass\nelse:\n    open('x', 'w')", "writes a file"),
    ],
)
def test_what_goes_beyond_the_robot_is_told(text: str, told: str) -> None:
    (said,) = reaches(text)
    assert told in said
    assert "is_simulating()" in said


@pytest.mark.parametrize(
    "text",
    [
        "open('table.csv')",
        "open('table.csv', 'r', newline='')",
        "import os\nos.path.join('a', 'b')",
        "import urllib.parse\nurllib.parse.quote('a')",
        "magdeck.open_labware_latch()\nlid.open('now')",
        "if not c.is_simulating():\n    open('x', 'w')",
        "socket = rack['A1']\np.aspirate(5, socket)",
        "def run(:",
    ],
)
def test_what_stays_in_the_rehearsal_is_not(text: str) -> None:
    assert reaches(textwrap.dedent(text)) == []
