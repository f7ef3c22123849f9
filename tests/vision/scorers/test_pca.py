"""The paper's world model and its files."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from aegis_ot.errors import ConfigurationError, ModelError
from aegis_ot.vision.crops import CANVAS, crop_grey, trajectory_vector
from aegis_ot.vision.models import load_model, save_model
from aegis_ot.vision.scorers import make_scorer
from aegis_ot.vision.scorers.pca import PcaScorer
from aegis_ot.vision.types import TipDetection
from aegis_ot.vocabulary import KeyframeKind
from tests.vision.samples import sample


def normals(count: int = 24) -> list:
    return [sample(f"n{i}", plate=f"p{i % 4}", seed=i) for i in range(count)]


def test_the_vector_is_four_grey_crops_of_48() -> None:
    vector = trajectory_vector(sample())
    assert vector.shape == (9216,)
    assert vector.dtype == np.float32
    assert 0 <= vector.min() < vector.max() <= 1


def test_a_crop_keeps_the_tips_shape_and_pads_with_black() -> None:
    image = np.full((100, 100, 3), 200, dtype=np.uint8)
    crop = crop_grey(image, TipDetection(40, 10, 10, 80, 1, (45, 90), (45, 10)))
    assert crop.shape == (CANVAS, CANVAS)
    assert crop[:, :18].max() == 0
    assert crop[:, 22:26].min() > 0.7


@pytest.mark.parametrize("box", [(-30, -30, 50, 50), (90, 90, 50, 50), (500, 500, 10, 10)])
def test_boxes_over_the_edge_do_not_break_a_crop(box) -> None:
    image = np.full((100, 100, 3), 200, dtype=np.uint8)
    crop = crop_grey(image, TipDetection(*box, 1, (0, 0), (0, 0)))
    assert np.isfinite(crop).all()


def test_a_missing_tip_gives_a_blank_crop() -> None:
    assert not trajectory_vector(sample(tip=False)).any()


def test_the_score_is_the_squared_distance_to_the_plane_of_normals() -> None:
    rng = np.random.default_rng(0)
    plane = rng.normal(size=(3, 50))
    pca = PcaScorer(3)
    pca.fit_vectors(rng.normal(size=(20, 3)) @ plane)
    normal = np.linalg.qr(plane.T, mode="complete")[0][:, 3]
    assert pca.score_vector(rng.normal(size=3) @ plane) == pytest.approx(0, abs=1e-12)
    assert pca.score_vector(rng.normal(size=3) @ plane + 2 * normal) == pytest.approx(4)


def test_fewer_samples_than_components_are_no_obstacle() -> None:
    pca = PcaScorer()
    pca.fit(normals(4))
    assert len(pca.components) == 3
    assert pca.score(sample(left=0.5)) > pca.score(sample(seed=99))
    pca.fit(normals(1))
    assert len(pca.components) == 0
    assert pca.score(sample(seed=3)) > 0


def test_an_unknown_scorer_is_refused_with_the_choices() -> None:
    with pytest.raises(ConfigurationError, match="pair, ensemble"):
        make_scorer("magic")


def test_a_model_file_gives_the_same_scores(tmp_path: Path) -> None:
    pca = PcaScorer()
    pca.fit(normals())
    save_model(tmp_path / "m.npz", "pca", *pca.to_arrays(), {"normals": 24})
    model = load_model(tmp_path / "m.npz", "pca")
    assert model.data == {"normals": 24}
    again = PcaScorer.from_model(model)
    for left in (0.0, 0.5):
        strange = sample(seed=7, left=left)
        assert again.score(strange) == pytest.approx(pca.score(strange), rel=1e-4)


def test_a_damaged_model_file_is_refused(tmp_path: Path) -> None:
    path = tmp_path / "m.npz"
    pca = PcaScorer()
    pca.fit(normals(5))
    save_model(path, "pca", *pca.to_arrays(), {})
    whole = path.read_bytes()
    for damaged in (whole[:-300], whole[: len(whole) // 2], b"", b"PK\x03\x04 nonsense"):
        path.write_bytes(damaged)
        with pytest.raises(ModelError, match=r"m\.npz"):
            load_model(path)
    path.write_bytes(whole)
    with pytest.raises(ModelError, match="wanted 'column'"):
        load_model(path, "column")
    with pytest.raises(ModelError, match="no such model"):
        load_model(tmp_path / "none.npz")


def test_a_changed_number_fails_the_checksum(tmp_path: Path) -> None:
    path = tmp_path / "m.npz"
    save_model(path, "pca", {"mean": np.zeros(3)}, {}, {})
    with np.load(path) as entries:
        arrays = {name: entries[name] for name in entries.files}
    arrays["mean"] = np.ones(3)
    np.savez(path, **arrays)
    with pytest.raises(ModelError, match="checksum"):
        load_model(path)


def test_a_pickle_in_a_model_file_is_never_opened(tmp_path: Path) -> None:
    class Bomb:
        def __reduce__(self):
            return (Path(tmp_path / "exploded").touch, ())

    path = tmp_path / "m.npz"
    np.savez(path, description=np.array([Bomb()], dtype=object))
    with pytest.raises(ModelError):
        load_model(path)
    assert not (tmp_path / "exploded").exists()
    with pytest.raises(ModelError, match="cannot stand"):
        save_model(path, "pca", {"mean": np.array(["x"])}, {}, {})


def test_keyframes_keep_their_places_in_the_vector() -> None:
    vector = trajectory_vector(sample(drawn=0.8)).reshape(len(KeyframeKind), -1)
    assert vector[0].mean() < vector[3].mean()
