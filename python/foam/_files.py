"""Files of models: written whole, or not at all."""

from __future__ import annotations

import os
from pathlib import Path

from .errors import UsageError


def same_file(first: Path, second: Path) -> bool:
    return first.exists() and second.exists() and first.samefile(second)


def make_folder_of(file: Path) -> None:
    """Make the folder of the meshes beside a file; that of the file itself is to be there."""
    try:
        file.parent.mkdir(exist_ok=True)
    except OSError as error:
        raise UsageError(f"{file.parent}: it cannot be made ({error.strerror}); remedy: check its folder") from None


def write_whole(file: Path, content: bytes) -> None:
    """In one step, so that a reader never sees half of it. A link stays; a device or a pipe is written to."""
    file = Path(os.path.realpath(file)) if file.is_symlink() else file
    if file.exists() and not file.is_file() and not file.is_dir():
        file.write_bytes(content)
        return
    partial = file.with_name(f"{file.name}.partial-{os.getpid()}")
    try:
        partial.write_bytes(content)
        os.replace(partial, file)
    except OSError as error:
        partial.unlink(missing_ok=True)
        raise UsageError(
            f"{file}: it cannot be written ({error.strerror}); remedy: check that its folder exists"
        ) from None
