"""What decides moves and may be another thing in the next run."""

from __future__ import annotations

import ast
import textwrap

import pytest

from aegis_ot.preflight.source import chances
from aegis_ot.preflight.source.nodes import Nodes


def found(body: str) -> dict[str, int]:
    text = textwrap.dedent(body)
    return chances(text, Nodes(ast.parse(text)))


@pytest.mark.parametrize(
    ("body", "what"),
    [
        (
            "import random\nrandom.shuffle(wells)\nfor well in wells: p.transfer(5, a, well)",
            "random",
        ),
        ("import random\nr = random.Random()\nr.shuffle(ws)\np.transfer(5, a, ws)", "random"),
        ("import os\nws.sort(key=lambda w: os.urandom(2))\np.transfer(5, a, ws)", "random"),
        ("import random\nws.append(random.choice(b))\np.transfer(5, a, ws)", "random"),
        (
            "import time\nif time.localtime().tm_hour > 12: ws.reverse()\np.transfer(5, a, ws)",
            "clock",
        ),
        ("import time\nif time.time() > t:\n    n = 5\np.mix(n, 20)", "clock"),
        ("from random import choice as pick\np.dispense(5, plate[pick('ABC') + '1'])", "random"),
        ("import numpy as np\nn = np.random.randint(9)\np.mix(n, 20)", "random"),
        ("if p.is_simulating():\n    return_ = 1\nelse:\n    p.drop_tip()", "is_simulating"),
        ("def run(c):\n    if c.is_simulating(): return\n    p.pick_up_tip()", "is_simulating"),
        ("dry = c.is_simulating()\nif not dry:\n    p.aspirate(5, a)", "is_simulating"),
        ("import time\nt = time.time()\nwhile time.time() < t + 9:\n    p.mix(2, 20)", "clock"),
        ("import datetime\nif datetime.datetime.now().hour > 12: p.drop_tip()", "clock"),
        ("import requests\nv = requests.get(u).json()\np.aspirate(v['ul'], a)", "network"),
        ("import os\np.mix(int(os.environ.get('ROUNDS', 3)), 20)", "environment"),
        ("import os\nn = int(os.getenv('N'))\np.mix(n, 20)", "environment"),
        ("import json\nwith open(f) as h:\n    d = json.load(h)\np.aspirate(d['ul'], a)", "file"),
        (
            "from pathlib import Path\nfor w in Path(f).read_text().split(): p.dispense(5, b[w])",
            "file",
        ),
    ],
)
def test_what_decides_moves_is_told_with_its_line(body, what):
    (said,) = found(body)
    assert what in said


@pytest.mark.parametrize(
    "body",
    [
        "import time\ntime.sleep(5)\np.aspirate(5, a)",
        "import time\nstarted = time.time()\np.aspirate(5, a)\nprint(time.time() - started)",
        "import time\nwhile time.time() < end:\n    c.delay(1)",
        "if not c.is_simulating():\n    take_a_picture()\np.aspirate(5, a)",
        "import json\nwith open(f) as h:\n    d = json.load(h)\n"
        "plate = c.load_labware_from_definition(d, 1)\np.aspirate(5, plate['A1'])",
        "import random\nr = random.Random(4)\nr.shuffle(ws)\np.transfer(5, a, ws)",
        "if not c.is_simulating():\n    seen.append(1)\np.aspirate(5, a)",
        "def random(x): return x\np.aspirate(random(5), a)",
        "p.transfer(5, a, b)  # in random order",
    ],
)
def test_what_decides_none_is_not(body):
    assert found(body) == {}
