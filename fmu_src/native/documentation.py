"""The page of documentation in an FMU."""

from __future__ import annotations

from html import escape

from fmu_src.python.variables import Variable

from .models import NativeModel

PAGE = """<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><title>{name}</title></head>
<body>
<h1>{name}</h1>
<p>{description}.</p>
<p>SI units. Displacements are downwards positive, forces compression positive, bending moments
sagging positive; wheel[1] leads. Connect position and contact force of every wheel from the
vehicle to the track, and the rail displacement back. Both close an algebraic loop: let the host
iterate, or step them one after the other with the force extrapolated, at 25 microseconds or
below.</p>
<p>An input set before a step is held over it. With linear_inputs it is the value at the end of the
step instead, reached on a straight line from the last one; in FMI 2.0 input derivatives do the
same for a host that sets them. Directional derivatives are those over the last step: of outputs at
its end by inputs at its end.</p>
<p>A step that is impossible is discarded: the instance is where it was before and may be stepped
again, with other inputs or a shorter step. The complete state can be saved, restored and
serialised.</p>
<table>
<tr><th>variable</th><th>unit</th><th>start</th><th>what</th></tr>
{rows}
</table>
<p>Part of railcosim, BSD-3-Clause; the headers of FMI in the folder of sources are those of the
Modelica Association under the 2-Clause BSD licence.</p>
</body>
</html>
"""


def document(model: NativeModel) -> bytes:
    """The page of a model, as HTML."""
    page = PAGE.format(
        name=escape(model.name),
        description=escape(model.description),
        rows="\n".join(_row(variable, model) for variable in model.variables),
    )
    return page.encode()


def _row(variable: Variable, model: NativeModel) -> str:
    kind = "constant" if variable.name in model.constants else variable.causality
    start = "" if variable.causality == "output" else str(variable.start)
    cells = (variable.name, variable.unit, start, f"{variable.description} ({kind})")
    return f"<tr>{''.join(f'<td>{escape(cell)}</td>' for cell in cells)}</tr>"
