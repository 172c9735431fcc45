"""The pure core: language, logic, world and planning. No HTTP, no database, no clock, no environment variable."""
