"""The shell around the core: HTTP, the store, the worker processes, the command line."""
