"""The modal basis of a track, computed once and kept in the user's cache under its content.

The key is a hash of everything the basis depends on: the parameters, the number of mode pairs, the
source of the modules that compute it and the versions of numpy and scipy. A changed track or a
changed program therefore never meets an old basis. A file begins with the hash of its content; a
damaged one is computed again.
"""

from __future__ import annotations

import hashlib
import io
import os
import sys
import tempfile
from dataclasses import asdict
from pathlib import Path

import numpy as np
import scipy

from track_fmu import (
    assembly,
    banded_polynomial,
    beam_element,
    eigensolver,
    modal,
    modal_subspace,
    sleeper,
)
from track_fmu.assembly import TrackMatrices
from track_fmu.modal import ModalBasis, compute_basis
from track_fmu.parameters import TrackParameters

CACHE_VARIABLE = "RAILCOSIM_CACHE"
DIGEST_SIZE = 32  # bytes of a SHA-256 before the content
# read while the modules are being loaded: the folder of an FMU may be gone later
PROGRAM = b"".join(
    Path(str(module.__file__)).read_bytes()
    for module in (
        beam_element,
        sleeper,
        assembly,
        modal_subspace,
        banded_polynomial,
        eigensolver,
        modal,
    )
)


def cache_directory() -> Path:
    """Folder of the cache: ``$RAILCOSIM_CACHE``, or the user's cache folder of the platform."""
    if chosen := os.environ.get(CACHE_VARIABLE):
        return Path(chosen)
    if sys.platform == "win32":
        base = os.environ.get("LOCALAPPDATA") or str(Path.home() / "AppData" / "Local")
    elif sys.platform == "darwin":
        base = str(Path.home() / "Library" / "Caches")
    else:
        base = os.environ.get("XDG_CACHE_HOME") or str(Path.home() / ".cache")
    return Path(base) / "railcosim"


def basis_key(parameters: TrackParameters, mode_pairs: int) -> str:
    """Hash of all that determines the basis."""
    digest = hashlib.sha256(f"numpy {np.__version__} scipy {scipy.__version__}".encode())
    digest.update(PROGRAM)
    for name, value in sorted(asdict(parameters).items()):
        digest.update(f"{name}={value!r};".encode())
    digest.update(f"mode_pairs={mode_pairs}".encode())
    return digest.hexdigest()


def cached_basis(
    parameters: TrackParameters, matrices: TrackMatrices, *, mode_pairs: int
) -> ModalBasis:
    """Modal basis of a track, from the cache if it is there.

    Parameters
    ----------
    parameters, matrices
        The same track.
    mode_pairs : int
        Retained pairs.
    """
    path = cache_directory() / "modal" / f"{basis_key(parameters, mode_pairs)}.basis"
    basis = _load(path, size=matrices.numbering.size)
    if basis is None:
        basis = compute_basis(matrices, mode_pairs=mode_pairs)
        _store(path, basis)
    return basis


def _load(path: Path, *, size: int) -> ModalBasis | None:
    """Read a basis; None if there is none, or if the file is not what was written."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    digest, content = data[:DIGEST_SIZE], data[DIGEST_SIZE:]
    if hashlib.sha256(content).digest() != digest:
        return None
    with np.load(io.BytesIO(content), allow_pickle=False) as arrays:
        basis = ModalBasis(eigenvalues=arrays["eigenvalues"], modes=arrays["modes"])
    return basis if basis.modes.shape == (size, len(basis.eigenvalues)) else None


def _store(path: Path, basis: ModalBasis) -> None:
    """Write a basis in one move; a cache that cannot be written is only a slower start."""
    content = io.BytesIO()
    np.savez(content, eigenvalues=basis.eigenvalues, modes=basis.modes)
    data = content.getvalue()
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, suffix=".tmp")
        try:
            with os.fdopen(handle, "wb") as file:
                file.write(hashlib.sha256(data).digest() + data)
            Path(name).replace(path)
        except BaseException:
            Path(name).unlink(missing_ok=True)
            raise
    except OSError:
        return
