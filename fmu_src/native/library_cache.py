"""Compiled libraries, kept in the user's cache under a hash of what they are compiled from."""

from __future__ import annotations

import hashlib
import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from fmu_src.archive import content_hash
from fmu_src.python.basis_cache import cache_directory

from .compiler import TARGETS, compile_library, recipe

DIGEST_SIZE = 32  # bytes of a SHA-256 before the content


def cached_library(
    model: str, target: str, *, name: str, notify: Callable[[str], None] | None = None
) -> bytes:
    """Shared library of a model, compiled if it is not in the cache.

    Parameters
    ----------
    model, target, name
        As for `compiler.compile_library`.
    notify : callable, optional
        Told in a few words when something has to be compiled.

    Raises
    ------
    compiler.CompilationError
        If it has to be compiled and cannot.
    """
    key = content_hash(recipe(model, target, name=name))
    path = cache_directory() / "native" / f"{name}-{target}-{key}{TARGETS[target].suffix}"
    library = _load(path)
    if library is None:
        if notify is not None:
            notify(f"compiling {name} for {target}")
        library = compile_library(model, target, name=name)
        _store(path, library)
    return library


def _load(path: Path) -> bytes | None:
    """The library; None if there is none, or if the file is not what was written."""
    try:
        data = path.read_bytes()
    except OSError:
        return None
    digest, content = data[:DIGEST_SIZE], data[DIGEST_SIZE:]
    return content if hashlib.sha256(content).digest() == digest else None


def _store(path: Path, library: bytes) -> None:
    """Write it in one move; a cache that cannot be written is only a slower build."""
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        handle, name = tempfile.mkstemp(dir=path.parent, suffix=".tmp")
        with os.fdopen(handle, "wb") as file:
            file.write(hashlib.sha256(library).digest() + library)
        Path(name).replace(path)
    except OSError:
        return
