"""One figure module per kind of design."""
