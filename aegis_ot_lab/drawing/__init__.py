"""Data sets drawn with the simulated camera, and single frames to train and measure on."""

from .dataset import write_dataset
from .random_frames import random_frames

__all__ = ["random_frames", "write_dataset"]
