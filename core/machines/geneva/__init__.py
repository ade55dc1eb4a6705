"""A Geneva drive: begin with `spec` and `design`, where its motion in closed form stands."""
