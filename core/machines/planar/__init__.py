"""Any planar mechanism, of links, pins, slides, slots and teeth: begin with `structure`, `system`, then `design`."""
