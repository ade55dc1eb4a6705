"""Moving pictures: one module per kind that moves, named after it, with build(design, fraction)."""
