"""Layer 1 for programs beside the user: an editor's language server, and tools for an agent."""
