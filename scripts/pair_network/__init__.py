"""How the shipped pair network was made: it reads a tip before and after its dispense.

``python -m scripts.pair_network --help``; what uses it is ``aegis_ot.vision.scorers.pair``.
"""
