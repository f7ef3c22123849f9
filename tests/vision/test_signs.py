"""Every sign that a scorer can name has words."""

from __future__ import annotations

from aegis_ot.vision.scorers.column import PRIORS
from aegis_ot.vision.scorers.ensemble import EnsembleScorer
from aegis_ot.vision.signs import SIGNS
from aegis_ot.vocabulary import KeyframeKind

from .column.drawn import normals, trajectory


def test_no_sign_is_without_words_and_none_is_made_up() -> None:
    assert set(SIGNS) == {*PRIORS, "pair"}
    scorer = EnsembleScorer()
    scorer.fit(normals())
    assert set(scorer.signs(trajectory("n", "new", seed=91))) <= set(SIGNS)


def test_a_sign_is_looked_for_in_the_frames_that_show_it() -> None:
    assert SIGNS["retained"].frames == (KeyframeKind.DISPENSE, KeyframeKind.POST_DISPENSE)
    assert SIGNS["gap_transit"].frames == SIGNS["absent"].frames == (KeyframeKind.TRANSIT,)
    assert SIGNS["overfull"].frames == (KeyframeKind.ASPIRATE, KeyframeKind.TRANSIT)
