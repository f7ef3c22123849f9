"""What a world model's file tells of its reach."""

from __future__ import annotations

from aegis_ot.vision.models import ModelFile
from aegis_ot.worldmodel.reach import Smallest, normals_in, shortcomings, smallest_in

SEEN = Smallest("p20", "red", 10.0, 2.5, {"0.25": 1.0}, 6, 2.4, 3.5, 0, 8)


def model(normals: int, *seen: Smallest) -> ModelFile:
    recordings = [{"name": "a", "normals": normals - 1}, {"name": "b", "normals": 1}]
    return ModelFile(
        "ensemble", {}, {}, {"recordings": recordings, "smallest": [one.to_json() for one in seen]}
    )


def test_it_tells_what_would_be_caught_and_what_the_wells_were_too_few_for() -> None:
    sound = model(24, SEEN)
    assert smallest_in(sound) == [SEEN]
    assert normals_in(sound) == 24
    assert shortcomings(sound) == []
    few, unknown = shortcomings(model(3))
    assert "3 normal wells" in few
    assert "not known" in unknown
    assert shortcomings(ModelFile("pca", {})) == [], "nobody knows what made it"
