"""Linkages of three given gears in one unknown length: `external`, or `internal` with a ring; `forms` chooses.

`window_lengths` is what a length may be so that a window is met; the syntheses in `synthesis` solve for the unknown.
"""
