"""Derivatives of a native model against differences of its steps."""

import numpy as np


def central_difference(model, knowns, seed, unknowns, *, before, step, size):
    values = []
    for sign in (1.0, -1.0):
        model.state = before
        for name, share in zip(knowns, seed, strict=True):
            model.set_one(name, float(model.get([name])[0] + sign * size * share))
        model.step(model.time, step)
        values.append(model.get(unknowns))
    return (values[0] - values[1]) / (2.0 * size)


def check_derivative(model, knowns, seed, unknowns, *, step, size, agreement):
    """By the closed form, and by differences of steps from the same state."""
    before = model.state
    expected = central_difference(
        model, knowns, seed, unknowns, before=before, step=step, size=size
    )
    model.state = before
    model.step(model.time, step)
    after = model.state
    found = model.derivative(unknowns, knowns, seed)
    assert model.state.tobytes() == after.tobytes()
    np.testing.assert_array_equal(model.derivative(unknowns, knowns, seed), found)
    for stem in {name.rpartition(".")[2] for name in unknowns}:
        chosen = [i for i, name in enumerate(unknowns) if name.endswith(stem)]
        scale = np.max(np.abs(expected[chosen]))
        np.testing.assert_allclose(found[chosen], expected[chosen], atol=agreement * scale)
