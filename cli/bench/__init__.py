"""Run time against error, measured: one module per family of solvers, one for timing, one for pages."""
