"""English commands to actions, by a cqltl service."""
