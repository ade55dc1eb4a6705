"""A Geneva drive: begin with `spec` and `design`; its motion in closed form stands in `mechanism`."""
