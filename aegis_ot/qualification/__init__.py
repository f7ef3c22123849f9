"""Proof on a lab's own robot: it fails on purpose, and what the camera made of it is counted."""
