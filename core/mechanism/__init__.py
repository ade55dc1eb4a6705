"""Links in motion and the forces between them, of any mechanism: rates, closures, Newton and Euler, friction.

Begin with `links` and `joints`, then `dynamics`.
"""
