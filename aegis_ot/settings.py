"""Settings of the guard: keyword arguments over environment variables over a file."""
