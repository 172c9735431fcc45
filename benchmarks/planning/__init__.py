"""Our planner against Storm, mdpsolver and pymdptoolbox; see `benchmarks.planning.__main__`."""
