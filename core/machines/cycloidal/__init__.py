"""A cycloidal reducer: begin with `spec` and `design`; the disc and its forces stand in `disc`."""
