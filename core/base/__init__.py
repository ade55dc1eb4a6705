"""Parts that every kind of design file uses: designs, reports, kinds, fixes, texts; no mechanics."""
