"""What is asked of any design: loads, register, tolerance, search, clearance."""
