"""One frame as a camera gave it, before anybody asks for it."""

from __future__ import annotations

from dataclasses import dataclass, replace

from ...errors import CameraError
from ...vision.camera import Frame
from ...vision.types import Image
from .codec import decode_jpeg, encode_jpeg


@dataclass(frozen=True)
class Raw:
    """A frame as it came: ``jpeg`` or ``image`` is given, the other is made when it is wanted.

    ``exposed_at``: when its exposure began, ``time.monotonic``, s.
    """

    exposed_at: float
    jpeg: bytes | None = None
    image: Image | None = None

    def encoded(self) -> Raw:
        """The same to be kept: a decoded frame takes 6 MB."""
        if self.jpeg is not None or self.image is None:
            return self
        return replace(self, jpeg=encode_jpeg(self.image), image=None)

    def finished(self) -> Frame:
        """Both encoded and decoded.

        Raises:
            CameraError: It cannot be decoded, or there is nothing in it.
        """
        if self.jpeg is not None:
            image = decode_jpeg(self.jpeg) if self.image is None else self.image
            return Frame(self.jpeg, image, self.exposed_at)
        if self.image is None:
            raise CameraError("an empty frame")
        return Frame(encode_jpeg(self.image), self.image, self.exposed_at)
