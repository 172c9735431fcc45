"""What produces the figures that the docs quote."""
