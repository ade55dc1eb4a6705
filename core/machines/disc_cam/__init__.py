"""A disc cam with a translating or oscillating follower, roller, edge or flat; begin with `spec` and `design`."""
