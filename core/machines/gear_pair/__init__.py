"""A gear pair as a design: begin with `design`; its geometry is in `parts.gears`."""
