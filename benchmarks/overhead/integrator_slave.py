"""The integrator of the compiled FMU once more, for pythonfmu."""

from pythonfmu import Fmi2Causality, Fmi2Slave, Fmi2Variability, Real


class Integrator(Fmi2Slave):
    """dx/dt = rate * u, y = x + gain * u, exact for u held over a step."""

    def __init__(self, **kwargs: object) -> None:
        super().__init__(**kwargs)
        self.u = self.y = self.gain = self.rate = self.start = self.x = 0.0
        fixed = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.fixed}
        self.register_variable(Real("u", causality=Fmi2Causality.input))
        self.register_variable(Real("y", causality=Fmi2Causality.output))
        self.register_variable(Real("gain", **fixed))
        self.register_variable(Real("rate", **fixed))
        self.register_variable(Real("start", **fixed, setter=self.begin))

    def begin(self, start: float) -> None:
        """Take the initial value."""
        self.start = self.x = self.y = start

    def do_step(self, _time: float, step_size: float) -> bool:
        """Advance by `step_size` [s]."""
        self.x += step_size * self.rate * self.u
        self.y = self.x + self.gain * self.u
        return True

    def _get_fmu_state(self) -> tuple[float, float, float]:
        return self.x, self.u, self.y

    def _set_fmu_state(self, state: tuple[float, float, float]) -> None:
        self.x, self.u, self.y = state

    @staticmethod
    def _fmu_state_to_bytes(state: tuple[float, float, float]) -> bytes:
        return ",".join(map(repr, state)).encode()

    @staticmethod
    def _fmu_state_from_bytes(data: bytes) -> tuple[float, ...]:
        return tuple(map(float, data.decode().split(",")))
