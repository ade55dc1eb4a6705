"""Tables of rising functions read backwards.

Tolerance: the error of a cubic between neighbours, (h^4/384) max|d4x/dy4|: 1.6e-7 for asinh with steps of y below 0.16.
"""

from __future__ import annotations

import numpy as np

from gearlink.core.numerics.periodic import RisingTable

_PLACES = np.linspace(0.0, 2.0, 33)


def test_inverse_of_a_smooth_function() -> None:
    table = RisingTable(_PLACES, np.sinh(_PLACES), np.cosh(_PLACES))
    values = np.linspace(0.0, np.sinh(2.0), 501)
    np.testing.assert_allclose(table.places_of(values), np.arcsinh(values), rtol=0.0, atol=5e-7)


def test_error_falls_with_the_fourth_power_of_the_step() -> None:
    values, errors = np.linspace(0.3, 3.0, 997), []
    for count in (17, 33, 65):
        places = np.linspace(0.0, 2.0, count)
        table = RisingTable(places, np.sinh(places), np.cosh(places))
        errors.append(np.abs(table.places_of(values) - np.arcsinh(values)).max())
    assert errors[0] > 12.0 * errors[1] > 144.0 * errors[2]


def test_place_stays_between_the_neighbours_where_the_function_stands() -> None:
    places = np.linspace(-1.0, 1.0, 6)  # none at the standstill; then one there, where the inverse has no slope
    for each in (places, np.append(places, 0.0)):
        at = np.sort(each)
        table = RisingTable(at, at**5, 5.0 * at**4)
        values = np.linspace(-1.0, 1.0, 301)
        found = table.places_of(values)
        left = np.clip(np.searchsorted(at**5, values, side="right") - 1, 0, len(at) - 2)
        assert np.all((found >= at[left]) & (found <= at[left + 1]))
        assert np.all(np.diff(found) >= 0.0)


def test_rows_are_read_as_each_alone() -> None:
    sizes, values = np.array([[0.5], [1.0], [1.7]]), np.linspace(0.0, 1.0, 41)
    many = RisingTable(_PLACES, np.sinh(sizes * _PLACES), sizes * np.cosh(sizes * _PLACES))
    found = many.places_of(np.broadcast_to(values, (3, 41)))
    for row in range(3):
        alone = RisingTable(_PLACES, many.values[row], many.slopes[row])
        np.testing.assert_array_equal(found[row], alone.places_of(values))
