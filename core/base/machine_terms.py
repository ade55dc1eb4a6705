"""Words of a whole machine; a quantity of a member stands behind the member's name."""

from __future__ import annotations

from gearlink.core.base.term import Term

MACHINE = {
    "least_margin": Term("", "deg", "minimum margin of the relations between events", "own derivation"),
    "limiting_relations": Term("", "1", "relations that leave the free phases no greater margin"),
    "cycle_turns": Term("", "1", "turns of the main shaft after which everything repeats"),
    "phase": Term("", "deg", "machine angle at which the member's input angle is 0, as found", "own derivation"),
    "phase_room": Term("", "deg", "width of the interval in which the phase was taken", "own derivation"),
    "natural_frequencies": Term("f", "Hz", "natural frequencies of the main shaft", "Thomson, 12.4"),
    "critical_speeds": Term("n_c", "1/min", "speeds at which the main shaft turns once a period of its own", "60 f"),
    "machine_speed_limit": Term("", "1/min", "speed of the main shaft at which the first member reaches its limit"),
    "speed_limit_member": Term("", "1", "the member that limits the machine's speed"),
    "speed_limit_check": Term("", "1", "the check by which it does"),
    "members_without_loads": Term("", "1", "members that add nothing, since they have no section loads"),
    "wind_up_max_at": Term("", "deg", "machine angle of the maximum wind-up"),
    "wind_up_disc": Term("", "1", "the disc that is wound up most"),
    "wind_up_max": Term("", "deg", "maximum wind-up of a disc of the main shaft against the first one", "modes"),
    "wind_up_at_print": Term("", "mm", "shift of the register by the twist of the main shaft, alike in every machine"),
    "machine_yield": Term("", "1", "share of the machines that keep the allowed register", "normal law"),
}
