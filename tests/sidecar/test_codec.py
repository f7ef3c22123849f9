"""What a camera, or whoever stands in its place, sends is decoded within limits."""

from __future__ import annotations

import pytest

from aegis_ot.errors import CameraError
from aegis_ot.sidecar.cameras.codec import decode_jpeg

from .helpers import make_jpeg


def test_a_sound_jpeg_is_decoded() -> None:
    assert decode_jpeg(make_jpeg()).shape == (48, 64, 3)


def test_a_picture_that_claims_to_be_huge_is_refused_before_it_is_decoded() -> None:
    jpeg = bytearray(make_jpeg())
    place = jpeg.index(b"\xff\xc0")
    jpeg[place + 5 : place + 9] = b"\xff\xf0\xff\xf0"
    with pytest.raises(CameraError, match="65520 x 65520 px, is larger"):
        decode_jpeg(bytes(jpeg))


@pytest.mark.parametrize("junk", [b"", b"\xff\xd8\xff\xd9", b"\xff\xd8\xff\xe0\x00\x00\xff\xd9"])
def test_what_is_no_picture_is_refused(junk: bytes) -> None:
    with pytest.raises(CameraError):
        decode_jpeg(junk)
