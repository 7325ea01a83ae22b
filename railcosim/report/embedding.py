"""What a page needs, inside the page: scripts it may run, and data it cannot mistake for markup."""

from __future__ import annotations

import json
import re
from base64 import b64encode
from hashlib import sha256
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from markupsafe import Markup

if TYPE_CHECKING:
    from collections.abc import Iterable

    from numpy.typing import ArrayLike

_MARKUP_IN_SCRIPT = re.compile(r"<(?=/script|script|!--)", re.IGNORECASE)


class Script(NamedTuple):
    """A script in the page.

    Attributes
    ----------
    text : markupsafe.Markup
        What stands between the tags.
    digest : str
        How the page's policy names it.
    """

    text: Markup
    digest: str


def inline_script(source: str) -> Script:
    """Prepare a script to stand in a page.

    Parameters
    ----------
    source : str
        JavaScript, in which markup occurs in texts only, where a backslash changes nothing.
    """
    text = _MARKUP_IN_SCRIPT.sub(r"<\\", source.replace("\r\n", "\n").replace("\r", "\n"))
    digest = b64encode(sha256(text.encode()).digest()).decode("ascii")
    return Script(Markup(text), f"'sha256-{digest}'")  # noqa: S704 - ours and Plotly's, not the user's


def policy(scripts: Iterable[Script]) -> str:
    """Return a Content-Security-Policy: these scripts run, and nothing is fetched from anywhere."""
    return "; ".join(
        (
            "default-src 'none'",
            f"script-src {' '.join(script.digest for script in scripts)}",
            "style-src 'unsafe-inline'",  # Plotly sets the styles of what it draws
            "img-src data: blob:",  # the picture that a plot is saved as
            "base-uri 'none'",
            "form-action 'none'",
        )
    )


def inline_data(data: object) -> Markup:
    """Write data as JSON in which no character can end the element around it."""
    text = json.dumps(data, allow_nan=False, separators=(",", ":"))
    for character in "<>&":
        text = text.replace(character, f"\\u{ord(character):04x}")
    return Markup(text)  # noqa: S704 - no character of it is markup any more


def packed(values: ArrayLike) -> dict[str, str]:
    """Return numbers as Plotly takes arrays: float32, least significant byte first, in base64."""
    content = np.asarray(values, dtype="<f4").tobytes()
    return {"dtype": "f4", "bdata": b64encode(content).decode("ascii")}
