"""The worst designs of the long runs, and what they found, held to the limits of docs/accuracy.md in every run.

Against 40 digits of mpmath, whole drives against the second way in 80 bits; conditions as in the long tests.
"""

from __future__ import annotations

import math
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from oracles import forty_digits
from oracles.drive_search import turns
from oracles.long_drive import Drives
from stress.random_drives import Design, arrays
from stress.test_random_drives import (
    KEY_LIMITS,
    MOTION_LIMITS,
    QUANTITIES,
    Analysed,
    scalar,
    sweep,
    take_extremes,
    take_keys,
    take_worst,
)
from stress.worst import EPS, LONGER_NUMBERS, Worst

from gearlink.core.machines.planet_linkages.planet import PlanetLinkage
from gearlink.core.machines.three_gear.momentary import least_eccentricity
from gearlink.core.machines.three_gear.sweep import momentary_dwells
from gearlink.core.machines.three_gear.symmetric import dwell_angle
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.machines.wide_swing.device import Spring
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.parts.cams.profile import oscillating, profile, translating
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.slider_crank import SliderCrank

pytestmark = pytest.mark.usefixtures("forty_digits")


MOTION: list[tuple[tuple[float, float, float, float, int], tuple[int, int, int], float]] = [
    # short cranks, whose velocities may have no error of eps whatever their size: 7.2 eps of the condition
    (
        (39303.597244686265, 2935217.7808231814, 16143697.794527497, 17358141.17794813, -1),
        (16, 20, 178),
        3.3845772100250464,
    ),
    (
        (0.0002743280152089413, 0.01139862322079868, 0.08865595838398974, 0.07844847499813319, -1),
        (13, 14, 196),
        -8.875729215147889,
    ),
    # the worst three of 100,000 for the output angle, the speed and the acceleration
    (
        (213.5770499969173, 26.35201289765813, 234.87663669651815, 0.027818036447942625, -1),
        (10, 13, 192),
        12.111941538587597,
    ),
    (
        (0.5197897420865567, 7.955454819441178, 8.468709969082544, 0.006218514438744751, -1),
        (31, 93, 39),
        -3.8026224620923923,
    ),
    ((10.166301409699576, 185875.78083844, 58609.48044455315, 127293.1585019163, -1), (99, 12, 23), -5.903945090791386),
    (
        (550.5914228467461, 992.7453912513997, 1092.8541702011205, 650.7811683071775, -1),
        (66, 53, 78),
        0.09690506623169348,
    ),
    (
        (0.0005451386795327577, 2.8940646673247747, 0.8657458406527104, 2.0294476683853535, 1),
        (95, 22, 13),
        -12.523054656231556,
    ),
    (
        (881092.7517233482, 1365139.5785524356, 4175721.0638074493, 3704548.8588673924, 1),
        (22, 12, 92),
        1.049272964390692,
    ),
    (
        (89677.55314017313, 225857.77143667714, 180178.67159555142, 153289.63069111313, 1),
        (38, 51, 20),
        -0.8268360529427881,
    ),
    (
        (0.0034110639553099056, 0.03231386300368969, 0.16902636032699223, 0.140128522596186, -1),
        (18, 21, 183),
        -3.1578575672625018,
    ),
    (
        (630.9718444680733, 1372.3969588583948, 2442.866586767943, 1705.2031703775451, -1),
        (23, 27, 62),
        -1.7472767888362952,
    ),
]


@LONGER_NUMBERS
def test_motion_of_whole_drives() -> None:
    drawn = [Design("", FourBar(*links), GearTrain(*teeth)) for links, teeth, _ in MOTION]
    phi, worst = np.array([case[2] for case in MOTION]), Worst()
    for way in (scalar, sweep):
        columns = np.array([way(design, float(x)) for design, x in zip(drawn, phi, strict=True)]).T
        found = dict(zip(QUANTITIES, columns, strict=True))
        take_worst(worst, Drives.three_gears(*arrays(drawn)), phi, found, ["" for _ in drawn], drawn)
    worst.check("worst whole drives", len(drawn), MOTION_LIMITS)


@pytest.mark.quick(2)
@LONGER_NUMBERS
@pytest.mark.parametrize(
    ("links", "ratio", "carrier", "phi"),
    [
        (
            (4.0139908158611024e-06, 3.88344773007449e-06, 1.1411024193080364e-06, 4.118031738342833e-10, 1),
            -3.0801121933867734,
            "crank",
            -9.614655945552135,
        ),
        (
            (0.0043236142392006245, 0.004244916412276612, 0.00020958634051091574, 3.544392243504827e-08, -1),
            0.8370459397524102,
            "crank",
            -7.310998011842195,
        ),
        (
            (0.004407869411872091, 3.9654066383581745, 0.05888837198500394, 3.9331599833312225, -1),
            -0.37067104944564544,
            "crank",
            7.643429053126024,
        ),
        (
            (2.195820203870654e-05, 4.732570106003992e-06, 1.9430313092192155e-05, 4.433822446690987e-07, -1),
            0.10717303696543273,
            "rocker",
            -0.7862173750766921,
        ),
        (
            (16.545761272862762, 14.123029744520373, 5.542695008298374, 0.001847677934776751, -1),
            0.39624619826859053,
            "rocker",
            -3.975670587831461,
        ),
        (
            (5.474140161452316e-09, 3.66899790699939e-05, 0.0009733916035613357, 0.0009830942955803387, -1),
            0.11948237623922264,
            "rocker",
            -6.201758180624434,
        ),
    ],
)
def test_drives_without_an_idler(links: Any, ratio: float, carrier: Any, phi: float) -> None:
    *lengths, side = links
    planet, worst = PlanetLinkage(FourBar(*lengths, side), ratio, carrier), Worst()
    drives = Drives.one_mesh(np.array(lengths)[:, None], np.array([side]), np.array([ratio]), carrier)
    values = planet.angle(phi), planet.speed(phi), planet.acceleration(phi)
    found = {name: np.array([value]) for name, value in zip(QUANTITIES, values, strict=True)}
    take_worst(worst, drives, np.array([phi]), found, [""], [planet])
    worst.check("worst drives without an idler", 1, MOTION_LIMITS)


KEYS = [
    ((16852243.53628716, 5636552.4550923575, 22233068.017308746, 54399.783384860224, 1), (18, 36, 177)),
    ((0.028945677246664435, 0.09622566186482943, 0.10248424149831428, 0.035213810355819004, 1), (37, 86, 45)),
    ((0.5993874520832825, 0.3925192286745617, 0.23246284416648796, 0.025288091353899075, -1), (100, 106, 16)),
    ((0.2908527332958835, 20.305179457868558, 26.681201992948054, 46.06259173180709, -1), (15, 192, 80)),
    ((1.6922022091499511, 10.036816788684717, 6.147550283069389, 14.46935534277189, 1), (77, 83, 15)),
    ((2977.4007933864104, 5752.14067411159, 3566.327217949186, 5163.471413172089, -1), (32, 18, 13)),
    ((1353748.57003013, 22502521.334597476, 22502521.334597476, 31794563.96362703, -1), (13, 166, 13)),
]


@LONGER_NUMBERS
def test_key_quantities_of_whole_drives() -> None:
    drawn, worst = [Design("", FourBar(*links), GearTrain(*teeth)) for links, teeth in KEYS], Worst()
    for design, turn in zip(drawn, turns(Drives.three_gears(*arrays(drawn)), len(drawn)), strict=True):
        found = Analysed(design)
        take_extremes(worst, turn, found)
        if len(found.dwell_crank_angles) == 2:
            take_keys(worst, turn, found)
    worst.check("worst key quantities", len(drawn), KEY_LIMITS)


@pytest.mark.parametrize(
    ("links", "phi"),
    [
        (
            (1.7317199138300685e-05, 1.5139966098835326e-05, 1.708078410810492e-05, 6.650732261320832e-06, -1),
            -3.5319601036562367,
        ),
        (
            (5.644113683405585e-05, 4.2444169306689906e-05, 1.4378620336313588e-05, 4.293987248053408e-05, -1),
            0.8798621992862952,
        ),
        ((1440435.7667644024, 912864.3826500888, 981974.7832024839, 1459870.1060581743, -1), 1.4010792858516936),
    ],
)
def test_four_bars(links: Any, phi: float) -> None:
    a, b, c, d, side = links
    state, (coupler, rocker) = fourbar.solve(FourBar(*links), phi, 2), forty_digits.four_bar(links[:4], side, phi)
    near, longest = math.sin(state.transmission_angle), max(a, b, c, d)
    base = longest * (1.0 / math.hypot(d - a * math.cos(phi), a * math.sin(phi)) + 1.0 / min(b, c)) / near
    fastest = max(abs(float(coupler[1])), abs(float(rocker[1])), 1.0)
    gap = mp.mpf(state.rocker_angle) - rocker[0]
    assert abs(gap - 2 * mp.pi * mp.nint(gap / (2 * mp.pi))) <= 6.0 * EPS * base
    assert abs(state.rocker_velocity - rocker[1]) <= 4.0 * EPS * base * fastest / near
    assert abs(state.rocker_acceleration - rocker[2]) <= 8.0 * EPS * base * fastest**2 * longest / min(b, c) / near**2


@pytest.mark.parametrize(
    ("module", "teeth", "shifts", "alpha"),
    [
        (3.332776370701045, (108, 33), (-0.6662741011596889, -0.9606312495681035), 0.3576554099037928),
        (7828.679935145794, (22, 112), (0.6597585889995483, 0.7111030433421757), 0.46314639744025493),
    ],
)
def test_gear_pairs(module: float, teeth: tuple[int, int], shifts: tuple[float, float], alpha: float) -> None:
    exact = forty_digits.working_pressure_angle(teeth, shifts, alpha)
    terms = math.tan(alpha) - alpha + 2.0 * (abs(shifts[0]) + abs(shifts[1])) / sum(teeth) * math.tan(alpha)
    condition = max(1.0, terms / (float(exact) * math.tan(exact) ** 2))
    pair = GearPair(module=module, teeth=teeth, pressure_angle=alpha, given_shift=shifts)
    assert abs(pair.working_pressure_angle / exact - 1) <= 8.0 * EPS * condition
    distance = mp.mpf(module) * sum(teeth) / 2 * mp.cos(mp.mpf(alpha)) / mp.cos(exact)
    assert abs(pair.center_distance / distance - 1) <= 8.0 * EPS * max(1.0, condition * float(exact) * math.tan(exact))


def test_slider_crank() -> None:
    wanted, rod, offset = 0.01365311940426825, 0.011084884366623417, -0.006880788327584944
    crank = SliderCrank(wanted, rod, offset).crank_length
    slope = float(mp.diff(lambda r: forty_digits.stroke(r, rod, offset), mp.mpf(crank)))
    assert abs(forty_digits.stroke(crank, rod, offset) - mp.mpf(wanted)) <= 4.0 * EPS * (wanted + slope * crank)


@pytest.mark.parametrize(
    ("phi", "y", "y1", "sense"),
    [
        (1.616614944168792, 2.284352121959719, -0.6599312916257416, 1),
        (1.591384832637207, 1.5800693831768142, -0.05686500331225752, -1),
    ],
)
def test_cam_profiles(phi: float, y: float, y1: float, sense: int) -> None:
    arm = (4.0 + 0.0j, 2.0, 2.4 + 0.5 * y1, 0.3 * y)
    for path, exact in (
        (translating([y], [y1], offset=0.3), forty_digits.translating_profile(phi, y, y1, 0.3, sense, 0.2)),
        (oscillating(arm[0], arm[1], [arm[2]], [arm[3]]), forty_digits.oscillating_profile(phi, arm, sense, 0.2)),
    ):
        found, center = complex(profile([phi], path, sense=sense, roller_radius=0.2).profile[0]), path.position[0]
        condition = abs(center) * (1.0 + 0.2 / abs(path.first[0] - 1j * sense * center))
        assert abs(mp.mpc(found) - exact) <= 8.0 * EPS * condition


@pytest.mark.parametrize(
    ("i3", "phi12"),
    [
        (-0.5039585511585463, 0.5134038454305434),  # 31 ulp in the closed form of one design
        (-0.5186904734337612, 0.7193432343483801),
        (-0.5380198729692418, 1.0850017220512027),
        (-0.7003967280612687, 1.1140301474485852),
        (-45.48113738342396, 1.019516688822611),
    ],
)
def test_dwell_angles(i3: float, phi12: float) -> None:
    exact = forty_digits.dwell_angle(i3, phi12)
    found = dwell_angle(i3, phi12)
    assert abs(found - exact) <= 6.0 * math.ulp(found)


def test_momentary_frame() -> None:
    given = (0.0008535179682316082, 0.002496243352445013, 0.0021406896645754145, 0.0007233451118032593)
    low = least_eccentricity(*given[:3])
    exact = forty_digits.momentary_frame(*given)
    assert abs(float(momentary_dwells(*given).frame) / exact - 1) <= 8.0 * EPS * (1.0 + low / (given[0] - low))


def test_unloading_law() -> None:
    ratio, stretch, swing = 1.0821519614671504, 2.8394700618639734, 0.23684034035377036
    exact = forty_digits.energy_parameter(ratio, stretch, swing)
    assert abs(ElasticLaw(Spring(ratio, stretch), swing).energy_parameter / exact - 1) <= 64.0 * EPS
