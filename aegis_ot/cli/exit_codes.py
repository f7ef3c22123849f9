"""What a command ends with."""

CLEAN, FINDINGS, BROKEN, INTERRUPTED = 0, 1, 2, 130
