"""The general planar mechanism, made of links, pins, slides, slots, meshes and racks: begin with `structure`, then `design`."""
