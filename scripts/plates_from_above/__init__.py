"""Pictures of well plates from above, before and after a run, for the audit's tests and figures."""
