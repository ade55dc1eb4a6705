"""What all designs share: results by name, units at the border, reports, checks against limits, safe rounding.

Tolerances: conversions to degrees are math.degrees to the last bit; a bound rounded to the safe side may miss its
number by 1 part in 10^(digits - 1), never pass it by more than the rounding of the number itself.
"""

import math
from contextlib import contextmanager, nullcontext
from types import SimpleNamespace

import numpy as np
import pytest
from factory import design
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.design import Design, Outline, UnknownName, _bounded, placed
from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.nomenclature import term
from gearlink.core.base.report import Check, Report, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property, keep, kept, observed, step
from gearlink.core.parts.gears.codes import CONTACT_RATIO
from gearlink.core.parts.linkages.codes import TRANSMISSION_ANGLE


class Spec:
    """A design file."""

    name = "toy"

    def commands(self) -> tuple[str, ...]:
        return ("press", "gear")


class Toy(Design):
    """Quantities of every shape, under names of the nomenclature."""

    kind = "toy"
    outlines = {
        "press": Outline(("crank_length", "sync_start", "back_step_angle"), ("register",), ("positions",)),
        "gear": Outline(("tip_pressure_angle", "span_teeth", "motion", "crank_length"), ("undercut", "nothing")),
    }
    extra_tables = ("motion",)

    @cached_property
    def crank_length(self):
        return 12.5

    @cached_property
    def sync_start(self):
        return math.pi / 5.0

    back_step_angle = None
    tip_pressure_angle = (0.5, 0.25)
    span_teeth = (4, 5)

    @cached_property
    def motion(self):
        return "back-step"

    @cached_property
    def trap(self):
        raise AssertionError("nobody has asked for this")

    def check_register(self):
        return Check("GL506", "register", "pass", "it does", 0.0, 1.0)

    def check_undercut(self):
        for status in ("warn", "fail"):
            yield Check("GL201", "undercut", status, status)

    def check_nothing(self):
        return iter(())

    def table_positions(self, _samples):
        return Table("positions", ("input_angle", "phase"), ("deg", "1"), (np.array([0.0, 30.0]), ["sync", "dwell"]))

    def table_motion(self, samples):
        return Table("motion", ("speed",), ("1",), (np.array([math.inf, math.nan, -0.0] * (samples or 1)),))


@pytest.fixture
def toy():
    return Toy(Spec())


# Quantities


def test_lengths_stay_and_angles_become_degrees(toy):
    assert toy.quantity("crank_length").value == 12.5
    angle = toy.quantity("sync_start")
    assert (angle.value, angle.unit, angle.symbol) == (math.degrees(math.pi / 5.0), "deg", "phi_s")
    assert angle.words.startswith("input angle")


def test_pairs_become_lists_and_numbers_of_teeth_stay_whole(toy):
    assert toy.quantity("tip_pressure_angle").value == [math.degrees(0.5), math.degrees(0.25)]
    teeth = toy.quantity("span_teeth").value
    assert teeth == [4, 5]
    assert all(isinstance(n, int) for n in teeth)


def test_words_stay_words(toy):
    assert toy.quantity("motion").value == "back-step"


def test_quantity_that_does_not_apply_is_absent(toy):
    assert toy.quantity("back_step_angle") is None
    assert [q.name for q in toy.report("press").quantities] == ["crank_length", "sync_start"]


def test_names_are_given_once_in_the_order_of_the_commands(toy):
    assert toy.quantity_names() == (
        "crank_length",
        "sync_start",
        "back_step_angle",
        "tip_pressure_angle",
        "span_teeth",
        "motion",
    )
    assert toy.table_names() == ("positions", "motion")


@pytest.mark.parametrize("name", ["trap", "crank", "", "spec", "outlines", "table_positions"])
def test_unknown_quantity_names_the_known_ones(toy, name):
    with pytest.raises(UnknownName, match="quantity") as refusal:
        toy.quantity(name)
    assert (refusal.value.what, refusal.value.name) == ("quantity", name)
    assert refusal.value.known == toy.quantity_names()


def test_a_program_is_sent_to_the_list_of_names_and_a_command_line_to_its_option():
    refusal = UnknownName("quantity", "zzz", [f"q{number}" for number in range(15)])
    assert str(refusal).endswith("and 3 more, which `quantity_names()` lists")
    assert refusal.remedy.endswith("and 3 more, which --all shows")


def test_a_command_of_another_class_of_the_kind_is_told_how_to_open_it():
    """The section `loads` is in the file, and the command was said not to exist."""
    with pytest.raises(UnknownName, match=r"'loads'; give `load`, or `design`, command='loads'$"):
        design("loaded_feed", command="analyze").report("loads")
    with pytest.raises(UnknownName, match="; known: analyze"):
        design("loaded_feed", command="analyze").report("press")


def test_unknown_table_names_the_known_ones(toy):
    with pytest.raises(UnknownName, match="table") as refusal:
        toy.table("position")
    assert refusal.value.known == ("positions", "motion")


@pytest.mark.parametrize("names", [{"tables": ["position"]}, {"quantities": ["crank_length", "trap"]}])
def test_an_unknown_name_is_refused_before_anything_is_computed(toy, names):
    with pytest.raises(UnknownName):
        toy.report("gear", **names)
    assert set(vars(toy)) == {"spec"}


def test_results_are_computed_when_asked_for_and_kept(toy):
    assert set(vars(toy)) == {"spec"}
    toy.quantity("crank_length")
    assert set(vars(toy)) == {"spec", "crank_length"}
    toy.report("gear")
    assert "trap" not in vars(toy)


# Quantities that stand elsewhere


class Whole(Toy):
    """Quantities of a part and of a mesh that only `raw` knows."""

    outlines = {"press": Outline(("max_stroke", "back_step_angle", "contact_ratio", "base_radius"))}
    max_stroke: float = placed("part.stroke.value")
    back_step_angle: float | None = placed("missing.angle")
    missing = None

    @cached_property
    def part(self):
        return SimpleNamespace(stroke=SimpleNamespace(value=7.5))

    @property
    def base_radius(self):
        return self.part.nothing_of_that_name

    def raw(self, name):
        return 1.5 if name == "contact_ratio" else super().raw(name)


def test_a_quantity_may_stand_on_a_part():
    whole = Whole(Spec())
    assert (whole.max_stroke, whole.quantity("max_stroke").value) == (7.5, 7.5)
    assert whole.back_step_angle is None
    assert Whole.max_stroke.__doc__ == f"L{term('max_stroke').words[1:]}. Stands at `part.stroke.value`."
    assert Whole.back_step_angle.__doc__ == "Back-step of the output. Stands at `missing.angle`."


def test_every_quantity_is_an_attribute_and_listed():
    whole = Whole(Spec())
    assert whole.contact_ratio == 1.5
    assert set(whole.quantity_names()) < set(dir(whole))
    assert {"report", "table", "spec"} < set(dir(whole))
    assert "bench" not in dir(whole)  # of the program's own
    for name in ("contact", "crank_lenght"):
        with pytest.raises(AttributeError, match=name):
            getattr(whole, name)


def test_what_goes_wrong_inside_a_quantity_keeps_its_words():
    with pytest.raises(AttributeError, match="nothing_of_that_name"):
        _ = Whole(Spec()).base_radius


@pytest.mark.parametrize(
    ("name", "command"),
    [
        ("ty460_slider_crank", "crank"),
        ("ty460", "gear"),
        ("ty460", "crank"),
        ("ty460_input_gears", "gear"),
        ("two_gear_ring", "gear"),
        ("candy_feed", "gear"),
    ],
)
def test_attributes_of_worked_designs_are_their_quantities(name, command):
    made = design(name, command=command)
    for quantity in made.outline(command).quantities:
        assert getattr(made, quantity) == made.raw(quantity)
        assert quantity in dir(made)


# Watching


def test_an_observer_sees_each_result_once_as_it_is_computed():
    seen = []

    @contextmanager
    def watch(name):
        seen.append(name)
        yield
        seen.append("/" + name)

    toy = Toy(Spec())
    with observed(watch):
        for _ in range(2):
            toy.quantity("crank_length")
        toy.table("motion")
        toy.check("undercut")
    toy.quantity("sync_start")
    names = ("Toy.crank_length", "Toy.table_motion", "Toy.check_undercut")
    assert seen == [word for name in names for word in (name, "/" + name)]


def test_watching_ends_with_an_error():
    with pytest.raises(ValueError, match="mine"), observed(nullcontext):
        raise ValueError("mine")
    assert isinstance(step("any"), nullcontext)


# Reports


def test_report_of_a_command(toy):
    report = toy.report("press")
    assert (report.kind, report.name, report.command, report.ok) == ("toy", "toy", "press", True)
    assert [check.code for check in report.checks] == ["GL506"]
    assert [table.name for table in report.tables] == ["positions"]


def test_report_of_named_quantities_alone_runs_no_check(toy):
    report = toy.report("gear", quantities=("crank_length",))
    assert [q.name for q in report.quantities] == ["crank_length"]
    assert (report.checks, report.tables) == ((), ())


def test_report_with_further_tables_and_with_them_alone(toy):
    assert [t.name for t in toy.report("press", tables=("motion", "positions")).tables] == ["positions", "motion"]
    alone = toy.report("press", tables=("motion",), only=True)
    assert ([t.name for t in alone.tables], alone.quantities, alone.checks) == (["motion"], (), ())


def test_one_failing_check_fails_the_report(toy):
    report = toy.report("gear")
    assert [check.status for check in report.checks] == ["warn", "fail"]
    assert not report.ok
    assert Report("toy", "toy", "gear", checks=report.checks[:1]).ok


def test_table_rows_turn_columns_and_leave_out_what_is_no_number(toy):
    assert toy.table("positions").rows() == [[0.0, "sync"], [30.0, "dwell"]]
    assert toy.table("motion").rows() == [[None], [None], [-0.0]]


def test_rows_are_an_argument_of_the_table(toy):
    assert len(toy.table("motion", samples=4).rows()) == 12
    report = toy.report("press", tables=("motion",), samples=2)
    assert [len(table.rows()) for table in report.tables] == [2, 6]
    assert set(vars(toy)) == {"spec", "crank_length", "sync_start"}


def test_rows_run_on_from_block_to_block():
    count = 10_001
    x = np.arange(count) / 7.0
    gaps = np.where(np.arange(count) == 5000, np.nan, x)
    table = Table("t", ("x", "y", "word"), ("1", "1", "1"), (x, gaps, ["a"] * count))
    rows = list(table.each_row())
    assert table.length == len(rows) == count
    assert [row[0] for row in rows] == x.tolist()
    assert [i for i, row in enumerate(rows) if row[1] is None] == [5000]
    assert rows == [tuple(row) for row in table.rows()]
    assert list(table.thinned(1000).each_row()) == rows[::1000]


def test_a_zero_has_no_sign():
    """Whether a product that is zero is -0.0 depends on how a processor rounds; files of results must not."""
    table = Table("t", ("a", "b"), ("1", "1"), (np.array([-0.0, -1.0, np.nan]), np.array([-0.0, -np.inf, 0.0])))
    assert [str(value) for row in table.rows() for value in row] == ["0.0", "0.0", "-1.0", "None", "None", "0.0"]
    assert [str(value) for value in _bounded([-0.0, -2.0, math.inf])] == ["0.0", "-2.0", "None"]


def test_columns_of_unequal_length_are_a_fault():
    with pytest.raises(ValueError, match="zip"):
        Table("t", ("a", "b"), ("1", "1"), ([1.0], [1.0, 2.0])).rows()


# Errors


def test_key_is_given_where_there_is_none_yet():
    with pytest.raises(NoSolution) as refusal, at_key("outer"), at_key("inner"):
        raise NoSolution("no")
    assert refusal.value.key == "inner"
    with pytest.raises(NoSolution) as refusal, at_key("outer"):
        raise NoSolution("no", key="own")
    assert refusal.value.key == "own"
    assert (NoSolution("no").code, MissingSection("no").code) == ("GL112", "GL113")


# Limits


@pytest.mark.parametrize(
    ("value", "status"), [(40.0 - 1e-9, "fail"), (40.0, "warn"), (45.0 - 1e-9, "warn"), (45.0, "pass"), (90.0, "pass")]
)
def test_below_at_its_limits(value, status):
    check = TRANSMISSION_ANGLE.below(value, 40.0, 45.0, "deg", "the minimum angle", "lengthen l4")
    assert (check.status, check.value, check.limit, check.unit) == (status, value, 40.0, "deg")
    assert (check.fix == "lengthen l4") == (status != "pass")
    assert ("(limit >= 40 deg)" in check.message) == (status != "warn")
    assert ("(recommended >= 45 deg)" in check.message) == (status == "warn")


def test_ratio_has_no_unit_in_its_message():
    message = CONTACT_RATIO.below(1.05, 1.1, 1.2, "1", "contact ratio", "take more teeth").message
    assert message == "contact ratio: 1.05 (limit >= 1.1)"


@examples(200)
@given(value=st.floats(1e-6, 1e9) | st.floats(-1e9, -1e-6), digits=st.integers(2, 9))
def test_recommended_bounds_hold_as_printed(value, digits):
    low, high = float(safely_below(value, digits)), float(safely_above(value, digits))
    slack = 4e-16 * abs(value)
    assert low <= value + slack
    assert high >= value - slack
    width = 10.0 ** (1 - digits) * abs(value) * (1.0 + 1e-12)
    assert value - low <= width + slack
    assert high - value <= width + slack


@pytest.mark.parametrize(
    ("value", "low", "high"),
    [
        (1.6, "1.6", "1.6"),
        (16.41765, "16.41", "16.42"),
        (0.0, "0", "0"),
        (-2.5000049, "-2.501", "-2.5"),
        (123456.7, "123400", "123500"),
    ],
)
def test_recommended_bounds(value, low, high):
    assert (safely_below(value), safely_above(value)) == (low, high)


def test_a_result_that_is_known_is_not_computed_and_a_wrong_name_is_refused() -> None:
    class Owner:
        plain = 1.0

        @cached_property
        def found(self) -> float:
            raise AssertionError

    owner = Owner()
    assert kept(owner, "found") == {}
    keep(owner, found=2.0)
    assert (owner.found, kept(owner, "found")) == (2.0, {"found": 2.0})
    for name in ("plain", "fuond"):
        with pytest.raises(TypeError, match=rf"Owner\.{name} is not a result that is kept"):
            keep(owner, **{name: 3.0})
