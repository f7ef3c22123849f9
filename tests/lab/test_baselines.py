"""The paper's scorers, beside the package's own."""

from __future__ import annotations

import numpy as np
import pytest

from aegis_ot.errors import ConfigurationError
from aegis_ot_lab.scorers import BASELINES, make_scorer
from tests.vision.samples import sample
from tests.vision.scorers.test_pca import normals


@pytest.mark.parametrize("name", BASELINES)
def test_every_scorer_of_the_paper_learns_and_scores(name: str) -> None:
    scorer = make_scorer(name)
    scorer.fit(normals())
    usual = [scorer.score(sample(seed=100 + i)) for i in range(4)]
    assert np.isfinite(usual).all()
    assert min(usual) >= 0
    # The paper (SI B): failures project close to the origin, and forests flag normals too.
    if name not in ("mahalanobis", "isolation_forest"):
        assert scorer.score(sample(seed=9, left=0.5)) > max(usual)


def test_an_unknown_scorer_is_refused_with_the_choices() -> None:
    with pytest.raises(ConfigurationError, match="isolation_forest"):
        make_scorer("magic")


def test_no_normals_at_all_is_said() -> None:
    for name in BASELINES:
        with pytest.raises(ValueError, match="normal"):
            make_scorer(name).fit([])
