"""A small FMU that shows what it was given, and copies of it with units."""

import re
import zipfile

from pythonfmu.builder import FmuBuilder

slave = '''
from pythonfmu import Boolean, Fmi2Causality, Fmi2Slave, Fmi2Variability, Integer, Real, String


class Relay(Fmi2Slave):
    """`y` runs on a straight line from `start`, `seen` is what came in as `u`."""

    def __init__(self, **kwargs):
        super().__init__(**kwargs)
        self.u = self.y = self.seen = self.start = self.double = 0.0
        self.rate, self.count, self.flag, self.label = 1.0, 0, False, ""
        fixed = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.fixed}
        counted = {"causality": Fmi2Causality.output, "variability": Fmi2Variability.discrete}
        self.register_variable(Real("u", causality=Fmi2Causality.input))
        self.register_variable(Real("y", causality=Fmi2Causality.output))
        self.register_variable(Real("seen", causality=Fmi2Causality.output))
        self.register_variable(Real("double", causality=Fmi2Causality.output))
        self.register_variable(Integer("counted", **counted, getter=lambda: 2 * self.count))
        self.register_variable(Boolean("raised", **counted, getter=lambda: not self.flag))
        self.register_variable(Real("start", **fixed))
        self.register_variable(Real("rate", **fixed))
        self.register_variable(Integer("count", **fixed))
        self.register_variable(Boolean("flag", **fixed))
        self.register_variable(String("label", **fixed))

    def exit_initialization_mode(self):
        self.y, self.seen, self.double = self.start, self.u, 2.0 * self.u
        if self.label == "stop":
            raise ValueError("told to stop")

    def do_step(self, time, step):
        self.y = self.start + self.rate * (time + step)
        self.seen, self.double = self.u, 2.0 * self.u
        return True

    def _get_fmu_state(self):
        return {name: getattr(self, name) for name in ("u", "y", "seen", "double")}

    def _set_fmu_state(self, state):
        for name, value in state.items():
            setattr(self, name, value)
'''

definitions = {
    "m": 'm="1"',
    "mm": 'm="1" factor="1e-3"',
    "m/s": 'm="1" s="-1"',
    "km/h": 'm="1" s="-1" factor="0.27777777777777778"',
    "K": 'K="1"',
    "degC": 'K="1" offset="273.15"',
    "N": 'kg="1" m="1" s="-2"',
    "kN": 'kg="1" m="1" s="-2" factor="1000"',
}
"""Base units as both a model description and an SSD write them."""


def build(folder):
    source = folder / "relay.py"
    source.write_text(slave)
    return FmuBuilder.build_FMU(
        source, dest=folder, needsExecutionTool=False, canGetAndSetFMUstate=True
    )


def with_units(fmu, path, units, *, defined=True):
    """Copy an FMU; its variables have the units given, defined in SI base units or not."""
    named = dict.fromkeys(units.values())
    blocks = [f'<Unit name="{n}"><BaseUnit {definitions[n]}/></Unit>' for n in named if defined]
    blocks = blocks or [f'<Unit name="{n}"/>' for n in named]

    def change(text):
        for variable, unit in units.items():
            pattern = rf'(<ScalarVariable[^>]*name="{variable}"[^>]*>\s*<Real)'
            text, count = re.subn(pattern, rf'\1 unit="{unit}"', text)
            assert count == 1
        group = f"<UnitDefinitions>{''.join(blocks)}</UnitDefinitions>"
        return re.sub(
            r"(<(?:LogCategories|DefaultExperiment|ModelVariables))", group + r"\1", text, count=1
        )

    with zipfile.ZipFile(fmu) as source, zipfile.ZipFile(path, "w") as target:
        for name in source.namelist():
            data = source.read(name)
            if name == "modelDescription.xml":
                data = change(data.decode()).encode()
            target.writestr(name, data)
    return path
