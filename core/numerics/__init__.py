"""Roots, extremes, quadrature, elliptic integrals, least squares, linear programs, blocks: no word of mechanisms.

Begin with `roots` (one number, `math` alone) and `extremes` (functions of arrays).
"""
