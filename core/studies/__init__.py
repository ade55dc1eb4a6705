"""Analyses that apply to any design: loads, register, tolerance, search, clearance."""
