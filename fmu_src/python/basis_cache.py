"""The modal basis of a track, computed once and kept in the user's cache under its content.

The key is a hash of everything the basis depends on: the parameters, the number of mode pairs, the
source of the modules that compute it and the versions of numpy and scipy. A changed track or a
changed program therefore never meets an old basis. A damaged file is computed again.
"""

from __future__ import annotations

import hashlib
import os
import sys
import tempfile
import zipfile
from dataclasses import asdict
from pathlib import Path

import numpy as np
import scipy

from track_fmu import assembly, beam_element, eigensolver, modal
from track_fmu.assembly import TrackMatrices
from track_fmu.modal import ModalBasis, compute_basis
from track_fmu.parameters import TrackParameters

CACHE_VARIABLE = "RAILCOSIM_CACHE"
# read while the modules are being loaded: the folder of an FMU may be gone later
PROGRAM = b"".join(
    Path(str(module.__file__)).read_bytes()
    for module in (beam_element, assembly, eigensolver, modal)
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
    path = cache_directory() / "modal" / f"{basis_key(parameters, mode_pairs)}.npz"
    basis = _load(path, size=matrices.numbering.size)
    if basis is None:
        basis = compute_basis(matrices, mode_pairs=mode_pairs)
        _store(path, basis)
    return basis


def _load(path: Path, *, size: int) -> ModalBasis | None:
    """Read a basis; None if there is none or it is damaged (zip members carry a checksum)."""
    try:
        with np.load(path, allow_pickle=False) as arrays:
            eigenvalues, modes = arrays["eigenvalues"], arrays["modes"]
    except (OSError, ValueError, KeyError, EOFError, zipfile.BadZipFile):
        return None
    if modes.shape != (size, len(eigenvalues)):
        return None
    return ModalBasis(eigenvalues=eigenvalues, modes=modes)


def _store(path: Path, basis: ModalBasis) -> None:
    """Write a basis in one move; a cache that cannot be written is only a slower start."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        with tempfile.NamedTemporaryFile(dir=path.parent, suffix=".tmp", delete=False) as file:
            try:
                np.savez(file, eigenvalues=basis.eigenvalues, modes=basis.modes)
            except BaseException:
                Path(file.name).unlink()
                raise
        Path(file.name).replace(path)
    except OSError:
        return
