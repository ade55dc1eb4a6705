"""How many positions are computed together."""

# The intermediate arrays of a block stay in the cache; above 8192 complex numbers the C library maps and clears new
# pages for each of them, which doubles the time.
BLOCK = 8000
