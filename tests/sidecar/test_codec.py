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


@pytest.mark.parametrize("garbage", [b"\x00", b"AB", b"\xff\x00", b"\xff\xd3", b"\xff\x01"])
def test_garbage_before_a_marker_does_not_hide_the_size(garbage: bytes) -> None:
    """The decoder passes over it, and would take what follows at its word."""
    jpeg = bytearray(make_jpeg())
    place = jpeg.index(b"\xff\xc0")
    jpeg[place + 5 : place + 9] = b"\xff\xf0\xff\xf0"
    jpeg[2:2] = garbage
    with pytest.raises(CameraError, match=r"is larger|does not tell its size"):
        decode_jpeg(bytes(jpeg))


@pytest.mark.parametrize("junk", [b"", b"\xff\xd8\xff\xd9", b"\xff\xd8\xff\xe0\x00\x00\xff\xd9"])
def test_what_is_no_picture_is_refused(junk: bytes) -> None:
    with pytest.raises(CameraError):
        decode_jpeg(junk)
