"""One folder for each maker's Python: how its protocols are rehearsed, and its calls heard."""
