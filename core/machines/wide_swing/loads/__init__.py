"""The loads of a wide-swing mechanism: its rocker with device and slider, its cam shaft, the roller between them.

Begin with `design`.
"""
