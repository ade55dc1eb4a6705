"""The slider-crank as a design: begin with `design`."""
