"""Run time against error, measured in a checkout: `make bench`, `make bench-guard`, `python -m bench`."""
