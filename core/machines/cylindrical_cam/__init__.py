"""A cylindrical cam whose roller slides along its axis; begin with `spec` and `design`."""
