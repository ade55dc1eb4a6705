"""A disc cam with a translating or oscillating follower, roller or flat; begin with `spec` and `design`."""
