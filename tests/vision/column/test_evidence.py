"""Log-likelihood ratios: bounded, shrunk, and unimpressed by a glint in one frame."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.vision.column import DyeColour, EmptyColour, combine, look_at_tip, mean_dye
from aegis_ot.vision.column.evidence import colour_evidence, long_step, taper
from aegis_ot.vision.tips import tip_for

from .drawn import RED, WATER, detection, draw_tip


def test_a_dye_within_its_noise_is_no_dye() -> None:
    assert not np.any(DyeColour(0.01, 0.0, 0.01).vector)
    assert DyeColour(0.1, 0.0, 0.01).vector[0] == pytest.approx(0.098, abs=1e-3)


def test_dyes_are_averaged_by_their_precision() -> None:
    mean = mean_dye([DyeColour(0.1, 0.0, 0.01), DyeColour(0.4, 0.0, 1.0)])
    assert mean is not None
    assert mean.red == pytest.approx(0.1, abs=0.01)
    assert mean.sd < 0.011
    assert mean_dye([]) is None


def test_a_glint_in_one_frame_does_not_make_a_column() -> None:
    glint, nothing = np.array([8.0]), np.array([-1.5])
    assert combine(glint, glint)[0] == 16
    assert combine(glint, nothing, 4.0)[0] == 1.0


def test_a_step_has_no_finite_uncertainty_where_too_few_rows_lie_beside_it() -> None:
    u = np.linspace(0, 1, 200, dtype=np.float32)
    column = np.where(u > 0.6, taper(u), 0.0).astype(np.float32)
    step = long_step(u, column, 0.2, 0.95)
    assert np.isinf(step.sd[0])
    assert np.isinf(step.sd[-1])
    row = int(np.argmax(step.size))
    assert u[row] == pytest.approx(0.6, abs=0.02)
    assert step.size[row] == pytest.approx(1.0, abs=0.05)


def test_colour_speaks_for_its_own_dye_and_against_another() -> None:
    look = look_at_tip(draw_tip(top=0.6, dye=RED), detection(), tip_for("p1000")).profile
    clear = look_at_tip(draw_tip(top=0.6, dye=WATER), detection(), tip_for("p1000")).profile
    red, yellow = DyeColour(0.13, 0.0, 0.005), DyeColour(0.0, -0.13, 0.005)
    empty = EmptyColour()
    row = int(np.argmin(np.abs(look.u - 0.6)))
    assert colour_evidence(look, red, empty, top=0.15)[row] > 6
    assert colour_evidence(look, yellow, empty, top=0.15)[row] < 0
    assert -5 < colour_evidence(clear, red, empty, top=0.15)[row] < 0
