"""The loads of a wide-swing mechanism over its working stroke: what the cam gives, its contact, what vibrates after.

The device bears the inertia but for what it gives too much; that is all that the cam carries. The part of the stroke
where the roller touches nothing is left out of greatest force and pressure.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.design import Design, Outline, placed
from gearlink.core.errors import MissingSection, NoSolution
from gearlink.core.loads import codes
from gearlink.core.nomenclature import term
from gearlink.core.report import Check, Quantity, Table, safely_above
from gearlink.core.results import cached_property
from gearlink.core.wide_swing.design import WideSwingDesign

if TYPE_CHECKING:
    from gearlink.core.loads.cam_contact import LineContact
    from gearlink.core.loads.vibration import Oscillator, Panelled
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.wide_swing.cam import WideSwingCam
    from gearlink.core.wide_swing.loads_spec import SwingLoads as Section
    from gearlink.core.wide_swing.spec import WideSwingSpec

_RPM = 2.0 * math.pi / 60.0
_NAMES = (
    "contact_force_max",
    "hertz_pressure_max",
    "shear_depth",
    "roller_speed_max",
    "entrainment_speed_max",
    "cam_torque_max",
    "cam_torque_min",
    "cam_torque_rms",
    "lift_off_speed",
    "natural_frequency",
    "frequency_ratio",
    "rise_periods",
    "residual_amplitude",
    "residual_speed_limit",
)
_OWN_UNITS = {"lift_off_speed": "1/min", "residual_amplitude": "deg", "residual_speed_limit": "1/min"}


class WideSwingLoads(Design):
    """The working stroke by fractions k; speeds are those of a cam that turns evenly."""

    kind = "wide-swing-cam"
    spec: WideSwingSpec
    outlines = {
        "loads": Outline(
            _NAMES, ("contact-pressure", "contact-loss", "rigid-model", "residual-vibration"), ("contact_stroke",)
        )
    }
    extra_tables = ("spectrum",)
    advises = False

    @cached_property
    def section(self) -> Section:
        """The section `loads`."""
        if self.spec.loads is None:
            raise MissingSection("`loads` needs the section loads: {roller: {width: mm}}", key="loads")
        found: Section = self.spec.loads
        return found

    @cached_property
    def design(self) -> WideSwingDesign:
        """The geometry."""
        return WideSwingDesign(self.spec)

    @cached_property
    def cam(self) -> WideSwingCam:
        """The cam of the working stroke."""
        if self.spec.drive is not None:
            raise NoSolution("loads are those of a cam that turns evenly: leave out drive", key="drive")
        return self.design.even_cam

    @property
    def speed(self) -> float:
        """Speed of the cam [rad/s]."""
        return self.spec.speed * _RPM

    # The stroke

    def torque(self, k: Reals) -> Reals:
        """Torque that the cam must give the rocker [N m], positive in the sense of the stroke.

        T = J psi'' less the device, which gives (1 + reserve) times what the design speed needs
        """
        reserve = self.spec.unloader.reserve
        return -reserve * self.inertia_torque(k)

    def inertia_torque(self, k: Reals) -> Reals:
        """Torque that moves the rocker at the design speed, J gamma c/T^2 [N m]."""
        motion = self.design.motion
        found: Reals = motion.inertia * motion.swing / motion.stroke_time**2 * motion.plain_law.invariants(k, 2)[2]
        return found

    def ratio(self, k: Reals) -> Reals:
        """Rocker speed over cam speed."""
        motion = self.design.motion
        found: Reals = motion.swing / self.cam.cycle_angle * motion.plain_law.invariants(k, 1)[1]
        return found

    def force(self, k: Reals) -> Reals:
        """Force of the roller on its cam [N]."""
        return self.design.unloading.contact_force(self.cam, k)

    def relative_radius(self, k: Reals) -> Reals:
        """R = r_g (1 - r_g kappa) of roller and profile [mm], kappa positive where the body is convex."""
        radius = self.cam.roller_radius
        return radius * (1.0 - radius * self.cam.bulge(k))

    def way(self, k: Reals) -> Reals:
        """Way of the roller's centre over the cam, per cam angle [mm]."""
        import numpy as np

        curve = self.cam.curve
        return np.asarray(self.cam.center_distance * np.abs(curve.gradient(curve.state(k))))

    def roller_speed(self, k: Reals) -> Reals:
        """Speed of the roller about its own axis [rad/s]."""
        return (self.way(k) / self.cam.roller_radius - 1.0) * self.speed

    def entrainment(self, k: Reals) -> Reals:
        """Speed of both surfaces through the contact [mm/s]."""
        return self.way(k) * self.speed * self.relative_radius(k) / self.cam.roller_radius

    def contact(self, k: Reals) -> LineContact | None:
        """The Hertzian contact; None without a width."""
        if self.section.roller is None:
            return None
        from gearlink.core.loads.cam_contact import LineContact, plane_modulus
        from gearlink.core.loads.spec import Material

        material = self.section.material or Material()
        modulus = plane_modulus(material.modulus, material.poisson)
        return LineContact(self.force(k), self.relative_radius(k), self.section.roller.width, modulus)

    def _greatest(self, f: Any) -> float:
        from gearlink.core.numerics.extremes import maximum_over

        return max(maximum_over(f, *part, samples=128).value for part in self.design.contact_of(self.cam))

    contact_force_max: float = placed("design.contact_force")
    lift_off_speed: float = placed("design.unloading.lift_off_speed")

    @cached_property
    def hertz_pressure_max(self) -> float | None:
        """Greatest pressure of roller and cam [N/mm^2]."""
        if self.section.roller is None:
            return None
        return self._greatest(lambda k: self.contact(k).pressure)  # type: ignore[union-attr]

    @cached_property
    def shear_depth(self) -> float | None:
        """Greatest depth of the greatest shear stress [mm]."""
        if self.section.roller is None:
            return None
        return self._greatest(lambda k: self.contact(k).shear_depth)  # type: ignore[union-attr]

    @property
    def roller_speed_max(self) -> float:
        """Greatest speed of the roller where it touches [1/min]."""
        return self._greatest(lambda k: abs(self.roller_speed(k))) / _RPM

    @property
    def entrainment_speed_max(self) -> float:
        """Greatest entrainment speed where the roller touches [mm/s]."""
        return self._greatest(self.entrainment)

    # Torque of the cam

    def cam_torque(self, k: Reals) -> Reals:
        """Torque that drives the cam [N m]: what the rocker needs, times its speed ratio."""
        return self.torque(k) * self.ratio(k)

    @cached_property
    def cam_torque_max(self) -> float:
        """Greatest torque on the cam over the stroke [N m]."""
        from gearlink.core.numerics.extremes import maximum_over

        return maximum_over(self.cam_torque, 0.0, 1.0, joints=(0.5,), samples=256).value

    @cached_property
    def cam_torque_min(self) -> float:
        """Least torque on the cam over the stroke [N m]."""
        from gearlink.core.numerics.extremes import minimum_over

        return minimum_over(self.cam_torque, 0.0, 1.0, joints=(0.5,), samples=256).value

    @cached_property
    def cam_torque_rms(self) -> float:
        """Root mean square of it over the stroke [N m]."""
        from gearlink.core.loads.machine import Panels

        panels = Panels.over(1.0, [i / 32 for i in range(1, 32)])
        return math.sqrt(panels.integral(self.cam_torque(panels.nodes) ** 2))

    # Vibration after the stroke

    @cached_property
    def oscillator(self) -> Oscillator | None:
        """The rocker on the shaft that drives it; None where the file does not say."""
        from gearlink.core.loads.vibration import ASSUMED_DAMPING, Oscillator, bounded

        given = self.section.vibration
        if given is None:
            return None
        damping = ASSUMED_DAMPING if given.damping is None else given.damping
        if given.frequency is not None:
            frequency, key = 2.0 * math.pi * given.frequency, "frequency"
        else:
            frequency, key = math.sqrt((given.stiffness or 0.0) / self.design.motion.inertia), "stiffness"
        return Oscillator(bounded(frequency, self.speed, f"loads.vibration.{key}"), damping)

    def _stroke(self, slowest: float) -> Panelled:
        """The swing [deg] over the cam angle of the stroke."""
        from gearlink.core.loads.vibration import Panelled

        angle, swing = self.cam.cycle_angle, math.degrees(self.design.motion.swing)
        law, oscillator = self.design.motion.plain_law, self.oscillator
        assert oscillator is not None, "asked for only with a vibration"

        def bend(phi: Reals) -> Reals:
            import numpy as np

            found: Reals = swing / angle**2 * law.invariants(np.clip(phi / angle, 0.0, 1.0), 2)[2]
            return found

        return Panelled.of(bend, 0.0, angle, (0.5 * angle,), oscillator.frequency / slowest)

    @property
    def natural_frequency(self) -> float | None:
        """Natural frequency of the rocker [Hz]."""
        return None if self.oscillator is None else self.oscillator.frequency / (2.0 * math.pi)

    @property
    def frequency_ratio(self) -> float | None:
        """It over the frequency of the cam."""
        return None if self.oscillator is None else self.oscillator.frequency / self.speed

    @property
    def rise_periods(self) -> float | None:
        """Natural periods in the stroke."""
        if self.natural_frequency is None:
            return None
        return self.natural_frequency * self.cam.cycle_angle / self.speed

    @cached_property
    def residual_amplitude(self) -> float | None:
        """Amplitude that the stroke leaves in the dwell after it [deg]."""
        if self.oscillator is None:
            return None
        return self._stroke(self.speed).residual(self.oscillator, self.speed)

    @cached_property
    def residual_speed_limit(self) -> float | None:
        """Least speed of the cam at which that passes what is allowed [1/min]."""
        given, oscillator = self.section.vibration, self.oscillator
        if given is None or given.allowed_residual is None or oscillator is None:
            return None
        import numpy as np

        from gearlink.core.loads.vibration import speed_limit

        whole = self.cam.cycle_angle * oscillator.frequency / (2.0 * math.pi)
        speeds = whole / np.linspace(40.0, 1.0, 1951)
        found = speed_limit(self._stroke(whole / 40.0), oscillator, speeds, given.allowed_residual)
        return None if found is None else found / _RPM

    def quantity(self, name: str) -> Quantity | None:
        """As for every design; what carries its own unit is not turned into another."""
        if name not in _OWN_UNITS:
            return super().quantity(name)
        value, entry = self.raw(name), term(name)
        return None if value is None else Quantity(name, value, _OWN_UNITS[name], entry.symbol, entry.words)

    # Tables

    def table_contact_stroke(self, samples: int | None = None) -> Table:
        """Torque, force, pressure and speeds over the stroke; empty where the roller touches nothing."""
        import numpy as np

        count = samples or 100
        k = np.arange(count + 1) / count
        touching = self.design.touches(self.cam, k) & (k != 0.5)
        contact = self.contact(k[touching])

        def shown(values: Reals) -> Reals:
            found = np.full_like(k, np.nan)
            found[touching] = values
            return found

        none = np.full(np.count_nonzero(touching), np.nan)
        at = k[touching]
        columns = {
            "k": (k, "1"),
            "cam_angle": (np.degrees(k * self.cam.cycle_angle), "deg"),
            "main_force": (shown(self.force(at)), "N"),
            "main_pressure": (shown(none if contact is None else contact.pressure), "N/mm^2"),
            "main_radius": (shown(self.relative_radius(at)), "mm"),
            "roller_speed": (shown(self.roller_speed(at) / _RPM), "1/min"),
            "entrainment": (shown(self.entrainment(at)), "mm/s"),
            "input_torque": (self.cam_torque(k), "N m"),
        }
        return Table.of("contact_stroke", columns)

    def table_spectrum(self, samples: int | None = None) -> Table:
        """Residual vibration from 0.1 to 1.3 times the speed of the design."""
        import numpy as np

        if self.oscillator is None:
            raise MissingSection("this table needs loads.vibration: {frequency: Hz}", key="loads")
        shares, motion = np.linspace(0.1, 1.3, samples or 121), self._stroke(0.1 * self.speed)
        residual = [motion.residual(self.oscillator, float(share) * self.speed) for share in shares]
        columns = {
            "speed": (shares * self.spec.speed, "1/min"),
            "ratio": ((self.rise_periods or math.nan) / shares, "1"),
            "residual": (np.array(residual), "deg"),
        }
        return Table.of("spectrum", columns)

    # Checks

    def check_contact_pressure(self) -> Iterator[Check]:
        """GL607, where the file gives an allowed pressure."""
        allowed = None if self.section.material is None else self.section.material.allowed_pressure
        found, roller = self.hertz_pressure_max, self.section.roller
        if allowed is None or found is None or roller is None:
            return
        text = f"the roller presses with {found:.5g} N/mm^2"
        if found > allowed:
            width = safely_above(roller.width * (found / allowed) ** 2, 4)
            message = f"{text}, above {allowed:g}: set loads.roller.width to {width} or more"
            yield codes.CONTACT_PRESSURE.check("fail", message, found, allowed, "N/mm^2")
        else:
            status, more = ("warn", f", little below {allowed:g}") if found > 0.9 * allowed else ("pass", "")
            yield codes.CONTACT_PRESSURE.check(status, text + more, found, allowed, "N/mm^2")  # type: ignore[arg-type]

    def check_contact_loss(self) -> Check:
        """GL608: the device holds the roller on its cam up to the speed of lift-off."""
        speed, limit = self.spec.speed, self.lift_off_speed
        text = f"the roller leaves its cam at {limit:.5g} rev/min"
        if limit < speed * (1.0 - 1e-9):
            message = f"{text}, below the design's {speed:g}: raise unloader.reserve"
            return codes.CONTACT_LOSS.check("fail", message, limit, speed, "1/min")
        return codes.CONTACT_LOSS.check("pass", text, limit, speed, "1/min")

    def check_rigid_model(self) -> Iterator[Check]:
        """GL605."""
        ratio, limit = self.frequency_ratio, self.spec.limits.frequency_ratio
        if ratio is None:
            return
        text = f"the natural frequency is {ratio:.4g} times that of the cam; {self.rise_periods:.4g} natural periods "
        text += "in the stroke"
        status = "warn" if ratio < limit else "pass"
        yield codes.RIGID_MODEL.check(status, text, ratio, limit)  # type: ignore[arg-type]

    def check_residual_vibration(self) -> Iterator[Check]:
        """GL610, where the file allows some."""
        given, found = self.section.vibration, self.residual_amplitude
        if given is None or given.allowed_residual is None or found is None:
            return
        allowed, text = given.allowed_residual, f"the rocker vibrates after its stroke by {found:.4g} deg"
        if found > allowed:
            message = f"{text}, more than {allowed:g}: lower the speed, or raise the natural frequency"
            yield codes.RESIDUAL_VIBRATION.check("fail", message, found, allowed, "deg")
        else:
            status, more = ("warn", f", little below {allowed:g}") if found > 0.8 * allowed else ("pass", "")
            yield codes.RESIDUAL_VIBRATION.check(status, text + more, found, allowed, "deg")  # type: ignore[arg-type]
