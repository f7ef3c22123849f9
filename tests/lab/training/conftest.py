"""A small data set to learn from."""

from __future__ import annotations

from pathlib import Path

import cv2
import numpy as np
import pytest

HEADER = (
    "trajectory_id,plate,well,pipette,reagent,label,failure_type,retained_fraction,volume_ul,"
    "aspirate,transit,dispense,post_dispense\n"
)
KEYFRAMES = ("aspirate", "transit", "dispense", "post_dispense")


@pytest.fixture
def dataset(tmp_path: Path) -> Path:
    """Two plates of two wells; a bright tip on a dark ground; the last well has no tip."""
    (tmp_path / "frames").mkdir()
    manifest, boxes = HEADER, "frame,x,y,w,h\n"
    for well in range(4):
        names = [f"frames/w{well}_{keyframe}.png" for keyframe in KEYFRAMES]
        manifest += f"t{well},plate{well // 2},A{well + 1},p300,red,normal,,,50,{','.join(names)}\n"
        for i, name in enumerate(names):
            image = np.full((240, 320, 3), 25, np.uint8)
            x = 60 + 40 * i + 5 * well
            image[0:60, x - 4 : x + 4] = 120
            if well < 3:
                image[60:140, x - 5 : x + 5] = 220
                boxes += f"{name},{x - 5},60,10,80\n"
            else:
                boxes += f"{name},,,,\n"
            cv2.imwrite(str(tmp_path / name), image)
    (tmp_path / "manifest.csv").write_text(manifest)
    (tmp_path / "boxes.csv").write_text(boxes)
    return tmp_path
