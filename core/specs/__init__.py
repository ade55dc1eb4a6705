"""The input of each kind of design as a strict, frozen model."""
