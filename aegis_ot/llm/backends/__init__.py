"""Where answers come from: services, recordings, scripts. Each is a module."""
