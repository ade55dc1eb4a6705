"""What every kind of file is: designs, reports, kinds, remedies, words; no mechanics."""
