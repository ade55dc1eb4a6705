"""Nothing is imported or computed that the asked-for result does not need."""

from __future__ import annotations

import json
import shlex
import subprocess
import sys
from functools import cache
from importlib.metadata import packages_distributions
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory

import factory
import pytest
from sweeps import spread

ROOT = Path(__file__).resolve().parents[2]
_PROBE = """
import io, json, shlex, sys
from contextlib import redirect_stdout, redirect_stderr
from gearlink.cli.main import run
found = []
for line in sys.argv[1:]:
    with redirect_stdout(io.StringIO()), redirect_stderr(io.StringIO()):
        status = run(shlex.split(line))
    found.append([int(status), sorted(sys.modules)])
print(json.dumps(found))
"""


def modules_after(*lines: str) -> list[set[str]]:
    """Modules loaded after each of several command lines in a process of their own."""
    done = subprocess.run([sys.executable, "-c", _PROBE, *lines], capture_output=True, text=True, cwd=ROOT, check=True)
    found = json.loads(done.stdout)
    assert [status for status, _ in found if status not in (0, 1)] == [], lines
    return [set(modules) for _, modules in found]


def packages(modules: set[str]) -> set[str]:
    return {name.partition(".")[0] for name in modules}


READING = {"annotated_types", "gearlink", "pydantic", "pydantic_core", "typing_extensions", "typing_inspection", "yaml"}
SCALAR_LINES = [
    "synth dwell designs/candy_feed.yaml",
    "synth momentary-dwell designs/thesis_example_3_mended.yaml",
    "synth back-step designs/thesis_example_1.yaml",
    "synth variable-speed designs/thesis_example_2.yaml",
    "gear designs/ty460_input_gears.yaml",
    "gear designs/rated_pair.yaml",
    "gear designs/ty460.yaml",
    "crank designs/ty460_slider_crank.yaml",
    "crank designs/ty460.yaml",
    "press designs/ty460.yaml --quantity crank_length",
    "analyze designs/six_bar_two_trains.yaml",
]
CHECKS = ["check designs/wide_lever.yaml", "check designs/two_gear_ring.yaml"]
LINES = ["crank designs/ty460_slider_crank.yaml", "press designs/ty460.yaml"]
VERSION = ["--version"]
ASKED = [*(f"explain {name}" for name in ("GL301", "contact_ratio", "gears.module", "gear-pair")), "schema gear-pair"]
NEW = ["new gear-pair"]
EXPORTS = ["export designs/ty460_input_gears.yaml --as svg --as csv --tolerance 0.1 -q --out OUT"]
SWEEP_LINES = [
    "analyze designs/thesis_example_3_as_printed.yaml",
    "press designs/ty460.yaml",
    "cam designs/ty460.yaml",
    "gripper designs/swing_gripper.yaml",
    "swing designs/wide_swing_twin_cam.yaml",
]


def as_json(lines: list[str]) -> list[str]:
    return [f"{line} --format json" for line in lines]


@cache
def ladder() -> dict[str, set[str]]:
    """Modules after each line in one process, those first that need minimum: what a line may not import none before it
    may either, so that a process for each line would say no more."""
    lines = [
        *VERSION,
        *ASKED,
        *NEW,
        *as_json(SCALAR_LINES),
        *CHECKS,
        *as_json(SWEEP_LINES),
        *EXPORTS,
        *LINES,
    ]
    with TemporaryDirectory() as folder:
        found = modules_after(*(line.replace("OUT", shlex.quote(folder)) for line in lines))
    return dict(zip(lines, found, strict=True))


def loaded_after(*lines: str) -> set[str]:
    """What is loaded once all these lines of the ladder have been run."""
    return max((ladder()[line] for line in lines), key=len)


def installed(modules: set[str]) -> set[str]:
    """The packages among the modules that do not come with Python."""
    return (packages(modules) & set(packages_distributions())) - {"_distutils_hack"}


@pytest.mark.parametrize(("lines", "besides"), [(SCALAR_LINES, set()), (SWEEP_LINES, {"numpy"})])
def test_results_as_json_import_what_reading_needs_and_no_more(lines: list[str], besides: set[str]) -> None:
    """Scalar commands no numpy, sweeps no scipy and no matplotlib, neither rich nor Typer."""
    modules = loaded_after(*as_json(lines))
    assert installed(modules) <= READING | {"_yaml"} | besides
    assert not {name for name in modules if name.startswith(("gearlink.cli.views.figures", "gearlink.cli.app"))}


_SEARCHES = {"studies.explore", "studies.study", "studies.tolerance", "studies.tolerance_study"}
_DATA = {
    "parts.gears.measures.allowances",
    "parts.gears.mesh.ring_cutter",
    "parts.gears.drawing",
}
_RINGS = {
    "parts.gears.mesh.ring_cutter",
    "parts.gears.outline.mesh_geometry",
}
_TOOLS = {"parts.gears.tooth.tools", "parts.gears.tooth.root_fillet", "parts.gears.data", "parts.gears.rating.load"}
_TRAINS = {
    "parts.gears.train.meshes",
    "parts.gears.train.key_sections",
    "parts.gears.keys.sections",
    "parts.gears.keys.pair",
}
_SECTIONS = {
    "parts.gears.keys.sections",
    "parts.gears.train.key_sections",
    "parts.linkages.spec_sections",
    "machines.three_gear.task_spec",
}
"""Models of sections and keys that most files do not have: making them takes longer than most results."""
_RATED = {
    "parts.gears.rating.rated",
    "parts.gears.rating.sheet",
    "parts.gears.keys.rating",
    "parts.gears.rating.materials",
}
_GENERAL = {"machines.three_gear.families", "machines.three_gear.register"}


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("line", "unused"),
    [
        (
            "synth dwell designs/candy_feed.yaml",
            _RINGS | _TOOLS | _GENERAL | _TRAINS | {"machines.three_gear.charts"},
        ),
        ("analyze designs/wide_lever.yaml", _RINGS | _TOOLS | _DATA | _TRAINS),
        (
            "gear designs/ty460_input_gears.yaml",
            _RINGS
            | _RATED
            | {"parts.gears.measures.allowances", "parts.gears.drawing", "parts.linkages", "parts.cams"},
        ),
        ("crank designs/ty460_slider_crank.yaml", _RINGS | _TOOLS | _DATA | {"parts.gears.mesh.pair", "parts.cams"}),
        ("press designs/ty460.yaml", _RINGS | _TOOLS | _DATA | {"parts.gears.mesh.pair", "studies.loads.machine"}),
    ],
)
def test_a_command_imports_no_room_that_it_does_not_enter(line: str, unused: set[str]) -> None:
    """Rings, tooth data, general families, loads and studies are imported by designs that have them."""
    (modules,) = modules_after(f"{line} --format json")
    named = {f"gearlink.core.{name}" for name in unused | _SEARCHES | _SECTIONS}
    assert all(map(find_spec, named)), "a name that nothing has would be imported by no command"
    assert not named & modules
    assert "pydantic.type_adapter" not in modules, "a section is validated by its own model"


def test_checks_of_scalar_designs_import_no_numpy() -> None:
    assert not packages(loaded_after(*CHECKS)) & {"numpy", "scipy", "matplotlib"}


def test_no_check_imports_masked_arrays() -> None:
    """`np.unique` and `np.median` would, for a hundredth of a second."""
    lines = spread(("measured_cam", "studies/dwell_feed", "planar_watt", "planar_bed_chain"), 2)
    (modules,) = modules_after("check " + " ".join(f"designs/{name}.yaml" for name in lines))
    assert "numpy" in modules
    assert "numpy.ma" not in modules


def test_help_imports_no_models() -> None:
    *_, modules = modules_after("--help", "synth --help")
    assert "numpy" not in modules
    assert not {m for m in modules if m.startswith("gearlink.core.") and "spec" in m.rpartition(".")[2]}
    assert not {m for m in modules if m in ("yaml", "scipy", "matplotlib", "gearlink.cli.commands.design")}


@pytest.mark.quick(1)
@pytest.mark.parametrize(("lines", "besides"), [(ASKED, set()), (NEW, {"yaml", "_yaml"})])
def test_what_is_known_of_files_needs_no_models(lines: list[str], besides: set[str]) -> None:
    """Explanations, schemas and templates come from two files: no pydantic, no Typer, no design class."""
    modules = loaded_after(*lines)
    assert installed(modules) <= {"gearlink"} | besides
    assert not {m for m in modules if m.startswith("gearlink.core.") and m.endswith((".spec", ".design"))}


@pytest.mark.slow
def test_reading_a_file_imports_no_metadata_of_packages() -> None:
    """pydantic looks for plug-ins when it makes its first model, and leaves it where the process says so."""
    line = [sys.executable, "-X", "importtime", "-m", "gearlink", "gear", "designs/ty460_input_gears.yaml", "-q"]
    done = subprocess.run(line, capture_output=True, text=True, cwd=ROOT, check=True)
    modules = {shown.rpartition("|")[2].strip() for shown in done.stderr.splitlines()}
    assert "pydantic.plugin._schema_validator" in modules
    assert not modules & {"importlib.metadata", "email", "socket", "zipfile"}


def test_what_else_a_pydantic_asks_of_its_finder_of_plugins_the_finder_gives() -> None:
    line = (
        "from gearlink.cli.main import _leave_plugins_out; _leave_plugins_out(); "
        "from pydantic.plugin._loader import get_plugins, PYDANTIC_ENTRY_POINT_GROUP as group; "
        "import pydantic.plugin._loader as finder; print(get_plugins(), group, *finder.get_plugins())"
    )
    done = subprocess.run([sys.executable, "-c", line], capture_output=True, text=True, check=True)
    assert done.stdout == "() pydantic\n"


def test_version_imports_no_typer() -> None:
    modules = loaded_after(*VERSION)
    assert installed(modules) <= {"gearlink"}
    assert "signal" not in modules, "whose enumerations take a tenth of the answer's time"


@pytest.mark.slow
def test_core_imports_no_interface() -> None:
    """One direction only: no module of core imports cli, typer, rich, yaml or matplotlib."""
    probe = (
        "import importlib, json, pkgutil, sys, gearlink.core\n"
        "for m in pkgutil.walk_packages(gearlink.core.__path__, 'gearlink.core.'):\n"
        "    importlib.import_module(m.name)\n"
        "tops = {m.partition('.')[0] for m in sys.modules}\n"
        "print(json.dumps(sorted(tops | {m for m in sys.modules if m == 'gearlink.cli'})))"
    )
    done = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=True)
    found = set(json.loads(done.stdout))
    assert not found & {"typer", "rich", "yaml", "matplotlib", "scipy", "highspy", "gearlink.cli"}


def test_key_results_that_pass_import_no_rich() -> None:
    assert "rich" not in packages(loaded_after("press designs/ty460.yaml"))


def test_results_in_a_terminal_import_no_matplotlib() -> None:
    assert "matplotlib" not in packages(loaded_after(*LINES))


def test_curves_as_svg_and_csv_import_no_dxf_library() -> None:
    assert not packages(loaded_after(*EXPORTS)) & {"ezdxf", "scipy", "matplotlib"}


@pytest.mark.slow
def test_a_picture_imports_neither_pyplot_nor_scipy(tmp_path: Path) -> None:
    *_, drawn = modules_after(*(f"{line} --plot --quiet --out {shlex.quote(str(tmp_path))}" for line in LINES))
    assert "matplotlib.figure" in drawn
    assert not drawn & {"matplotlib.pyplot", "scipy"}


@pytest.mark.slow
def test_an_animation_imports_no_matplotlib() -> None:
    """What moves is drawn by another library: the scene of a kind stands beside its figure, and needs none of it."""
    probe = (
        "import sys; from gearlink.core.base.kind import load; from gearlink.core.base.kinds import FILES\n"
        "places = {kind.scene for kind in FILES.values() if kind.scene}\n"
        "assert all(callable(load(place)) for place in places) and len(places) > 10\n"
        "print([name for name in sys.modules if name.startswith('matplotlib')])"
    )
    done = subprocess.run([sys.executable, "-c", probe], capture_output=True, text=True, check=True)
    assert done.stdout.strip() == "[]"


_PARTS = "names meanings bodies drives pins slides slots plays meshes cams size sizes numbers course"
"""What a planar mechanism is made of; its motion is followed where an extreme is asked for."""
_EVALUATED = [
    # command, design, quantity, what else the design works out for it
    ("synth dwell", "candy_feed", "crank_teeth", ""),
    ("synth dwell", "candy_feed", "rocker_length", "idler_teeth"),
    (
        "synth dwell",
        "candy_feed",
        "speed_ratio_max",
        "idler_teeth train general linkage output frame_ratio_at crank_angle_at",
    ),
    (
        "synth dwell",
        "candy_feed",
        "dwell_crank_angles",
        "idler_teeth train general linkage output frame_ratio_at crank_angle_at",
    ),
    ("synth back-step", "thesis_example_1", "coupler_length", "idler_teeth"),
    ("gear", "ty460_input_gears", "contact_ratio", "gear_pair rack"),  # `rack` is None: no gear on a rack
    ("crank", "ty460_slider_crank", "max_stroke", "slider_crank"),
    ("press", "ty460", "crank_length", "slider_crank"),
    ("press", "ty460", "initial_crank_angle", "slider_crank bed"),
    ("press", "ty460", "min_transmission_angle_cylinder", "cylinder"),
    ("press", "ty460", "sync_start", "slider_crank bed cylinder"),
    ("cam", "ty460", "follower_stroke", "slider_crank bed cylinder sync_start sync_end follower"),
    ("cam", "ty460", "cam_base_radius", "base_radius"),
    ("gripper", "swing_gripper", "total_swing", "law phases"),
    ("gripper", "swing_gripper", "handover_speed", "law phases state speed shaft_speed"),
    ("gripper", "swing_gripper", "min_transmission_angle", "law phases linkage unchecked"),
    ("cam", "swing_gripper", "max_pressure_angle", "law phases linkage unchecked section center main_cam return_cam"),
    ("swing", "wide_swing_twin_cam", "energy_parameter", "swing device plain_law"),
    ("swing", "wide_swing_twin_cam", "min_pivot_ratio", "swing"),
    ("swing", "wide_swing_twin_cam", "spring_rate", "swing device plain_law"),
    ("analyze", "six_bar_two_trains", "linkage_mobility", "links"),
    ("analyze", "mutilated_gear_press", "dwell_share", "mutilated"),
    ("analyze", "mutilated_gear_press", "rocker_swing", "linkage"),
    ("analyze", "two_gear_ring", "gear_ratio", ""),
    ("analyze", "two_gear_ring", "coupler_length", "linkage own_teeth"),  # which say what a centre distance is
    ("analyze", "wide_lever", "rocker_swing", "crank_length linkage own_teeth"),
    ("analyze", "lift_cam", "start_angle", ""),
    ("analyze", "lift_cam", "face_width_needed", "sense follower face_width"),
    ("analyze", "lift_cam", "lift_max", "sense follower motion motion_extremes"),
    ("analyze", "barrel_cam", "velocity_max", "follower_motion motion_extremes"),
    ("analyze", "barrel_cam", "max_pressure_angle", "follower_motion drum steepest"),
    ("analyze", "crank_rocker", "rocker_swing", "linkage dead_centers"),
    ("analyze", "crank_rocker", "speed_ratio_max", "linkage crank_range speed_turnings"),
    ("analyze", "planar_quick_return", "grashof", _PARTS),
    ("analyze", "planar_quick_return", "guide.velocity_ratio_max", f"{_PARTS} _found"),
    ("analyze", "sheet_press", "natural_frequencies", "own_names chain"),  # without its members' motions
    ("analyze", "measured_cam", "fit_rms", "points cam residuals"),
    ("analyze", "measured_cam", "min_curvature_radius", "points cam sharpest"),
    ("analyze", "geneva_drive", "wheel_radius", "drive"),
    ("analyze", "cycloidal_reducer", "output_hole_radius", ""),
    pytest.param("analyze", "quiet_law", "kappa", "law", marks=pytest.mark.slow),  # the law itself takes its time
]


@pytest.mark.parametrize(("command", "design", "quantity", "needed"), _EVALUATED)
def test_a_quantity_evaluates_what_it_needs_and_no_more(command: str, design: str, quantity: str, needed: str) -> None:
    made = factory.design(design, command=command)
    assert made.report(command, quantities=[quantity]).checks == ()
    assert _computed(made) - {quantity} <= set(needed.split())


def _computed(made: object) -> set[str]:
    """Names of the results that a design and its parts have worked out."""
    # the file as completed and as read, whether to advise, the kind that made it, and a function: nothing worked out
    given = ("spec", "asked", "advise", "kin", "_way_back")
    parts = [made]
    for part in parts:
        parts += [each for name, each in vars(part).items() if hasattr(each, "spec") and name not in given]
    return {
        name
        for each in parts
        for name, value in vars(each).items()
        if name not in given and not any(value is part for part in parts)
    }
