"""A co-simulation master for any FMUs, with rollback, event location and error control."""

import logging

from .audit_report import AuditReport
from .bond import Bond, bond_by_unit
from .bond_report import BondReport
from .coupling import Algorithm, Attempt, Coupling
from .decision import Accept, Candidate, Cause, Decision, Failure, Landed, Refine, Reject
from .errors import (
    DivergenceError,
    FmuError,
    InitialisationError,
    InputError,
    LoopGainError,
    OrchestratorError,
    ParticipantError,
    RollbackError,
    RunError,
    SettingsError,
    StepTooSmallError,
    SystemFileError,
    WiringError,
    ZenoError,
)
from .explicit import Explicit
from .fmu import FmuParticipant
from .fmu_check import Verdict, check_fmu
from .fmu_source import FmuSource
from .isolated import IsolatedParticipant
from .master import Master
from .newton import Newton
from .observers import Observer
from .outcome import Outcome, Statistics, StopReason, Switch
from .participant import OK, InputShape, Participant, Status, StatusKind, Variable, Vector
from .point_blocks import PointBlocks
from .recorder import LastPoint, Recorder
from .settings import MasterSettings
from .step_control import ErrorControl, FixedStep, StepController
from .step_log import StepLog
from .system import Connection, System
from .units import Linear, Unit, convert

# Who wants to see the messages adds a handler; warnings are in the outcome of a run, too.
logging.getLogger(__name__).addHandler(logging.NullHandler())

__all__ = [
    "OK",
    "Accept",
    "Algorithm",
    "Attempt",
    "AuditReport",
    "Bond",
    "BondReport",
    "Candidate",
    "Cause",
    "Connection",
    "Coupling",
    "Decision",
    "DivergenceError",
    "ErrorControl",
    "Explicit",
    "Failure",
    "FixedStep",
    "FmuError",
    "FmuParticipant",
    "FmuSource",
    "InitialisationError",
    "InputError",
    "InputShape",
    "IsolatedParticipant",
    "Landed",
    "LastPoint",
    "Linear",
    "LoopGainError",
    "Master",
    "MasterSettings",
    "Newton",
    "Observer",
    "OrchestratorError",
    "Outcome",
    "Participant",
    "ParticipantError",
    "PointBlocks",
    "Recorder",
    "Refine",
    "Reject",
    "RollbackError",
    "RunError",
    "SettingsError",
    "Statistics",
    "Status",
    "StatusKind",
    "StepController",
    "StepLog",
    "StepTooSmallError",
    "StopReason",
    "Switch",
    "System",
    "SystemFileError",
    "Unit",
    "Variable",
    "Vector",
    "Verdict",
    "WiringError",
    "ZenoError",
    "bond_by_unit",
    "check_fmu",
    "convert",
]
