"""Which C files make up every model; all of them lie in one folder."""

FMI = (
    "fmi2.c",
    "fmi2_values.c",
    "fmi3.c",
    "fmi3_absent.c",
    "fmi3_values.c",
    "fmu.c",
    "fmu_state.c",
    "fmu_step.c",
    "fmu_switch.c",
    "resource_file.c",
)
COMMON = ("binary.c", "checksum.c", "create.c", "model.c", "state.c", "variables.c")
ON_TRACK = (
    "basis.c",
    "bed.c",
    "characteristic.c",
    "curve.c",
    "dense.c",
    "exponential.c",
    "increments.c",
    "laws.c",
    "laws_setup.c",
    "observation.c",
    "operator.c",
    "operator_step.c",
    "preloaded_pad.c",
    "quasi_static.c",
    "rail_point.c",
    "rows.c",
    "static_start.c",
    "support_file.c",
    "support_line.c",
    "supports.c",
    "table_file.c",
    "track_memory.c",
    "track_setup.c",
    "window.c",
    "window_shift.c",
)
TRACK = (*ON_TRACK, "track.c", "track_derivative.c")
MOTION = ("curve.c", "motion.c", "table_file.c")
SURFACES = ("curve.c", "flat.c", "surfaces.c", "table_file.c", "tread.c")
SUSPENSION = ("dense.c", "equilibrium.c", "suspension.c", "suspension_setup.c")
VEHICLE = (
    *dict.fromkeys((*MOTION, *SURFACES)),
    *SUSPENSION,
    "excitation.c",
    "suspended_vehicle.c",
    "vehicle.c",
    "vehicle_outputs.c",
    "vehicle_setup.c",
    "wheel.c",
)
TRACK_CONTACT = (
    *dict.fromkeys((*ON_TRACK, *SURFACES)),
    "contact_memory.c",
    "contact_solution.c",
    "contact_start.c",
    "contact_step.c",
    "continuation.c",
    "track_contact.c",
)
MASSES = (
    *MOTION,
    *SUSPENSION,
    "masses.c",
    "masses_setup.c",
    "masses_start.c",
    "suspended_masses.c",
)
MODELS = {
    name: (*FMI, *COMMON, *own)
    for name, own in (
        ("track", TRACK),
        ("vehicle", VEHICLE),
        ("track_contact", TRACK_CONTACT),
        ("masses", MASSES),
    )
}
"""Sources of every model."""
