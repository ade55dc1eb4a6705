"""Roots, extremes, quadrature, elliptic integrals, double-double arithmetic, blocks: no word of mechanisms.

Begin with `roots` (one number, `math` alone) and `extremes` (functions of arrays).
"""
