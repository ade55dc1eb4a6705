"""Gauss quadrature. Tolerances: 4 ulp, since a polynomial of degree 19 is integrated exactly but for rounding."""

import math

import mpmath
import pytest

from gearlink.core.numerics.gauss import GAUSS_NODES, GAUSS_WEIGHTS, integral


def test_nodes_are_the_roots_of_the_legendre_polynomial():
    with mpmath.workdps(30):
        for x, w in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True):
            root = mpmath.findroot(lambda t: mpmath.legendre(10, t), x)
            slope = 10 * (root * mpmath.legendre(10, root) - mpmath.legendre(9, root)) / (root**2 - 1)
            assert x == float(root)
            assert w == pytest.approx(float(2 / ((1 - root**2) * slope**2)), rel=2e-16)


@pytest.mark.quick(3)
@pytest.mark.parametrize("degree", range(20))
def test_polynomials_are_exact(degree):
    exact = (3.0 ** (degree + 1) - 1.0) / (degree + 1)
    assert integral(lambda x: x**degree, 1.0, 3.0) == pytest.approx(exact, rel=1e-15)


def test_twentieth_degree_is_not():
    assert integral(lambda x: x**20, -1.0, 1.0) != pytest.approx(2.0 / 21.0, rel=1e-10)


def test_reversed_interval_changes_the_sign():
    assert integral(math.cos, 1.0, 0.0) == -integral(math.cos, 0.0, 1.0)
