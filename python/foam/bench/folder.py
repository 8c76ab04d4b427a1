"""The folder of results: filled under a temporary name, put in place at the end."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

from ..errors import UsageError, error_of

_LIST, _TITLE = ".foam-run", "files of a run of foam, format 1"


def _files_below(folder: Path) -> set[str]:
    return {str(path.relative_to(folder)) for path in folder.rglob("*") if path.is_symlink() or not path.is_dir()}


def _require_replaceable(target: Path) -> None:
    """Raise unless there is nothing, an empty folder, or one in which an earlier run wrote every file."""
    if not os.path.lexists(target) or (target.is_dir() and not any(target.iterdir())):
        return
    listed = (target / _LIST).read_text().splitlines() if (target / _LIST).is_file() else []
    if not target.is_dir() or listed[:1] != [_TITLE]:
        raise error_of(
            "output",
            f"{target}: exists, but is not the folder of a run (no {_LIST} in it), so foam does not replace it; "
            "remedy: choose another folder with --run-dir, or remove it",
        )
    others = sorted(_files_below(target) - {_LIST, *listed[1:]})
    if others:
        raise error_of(
            "output",
            f"{target}: {', '.join(others[:3])} in it: not written by the run that foam would replace; nothing was "
            "written; remedy: move it elsewhere, or choose another folder with --run-dir",
        )


def refuse_replacing(folder: Path, file: Path, force: bool) -> None:
    """Raise UsageError if the folder is to be replaced and the file lies in it, unless `force`."""
    if not force and folder.exists() and file.resolve().is_relative_to(folder.resolve()):
        raise UsageError(
            f"{folder}: the run would replace this folder, in which the input {file} lies; nothing was written; "
            "remedy: another folder, or --force"
        )


class Folder:
    """The results' folder. Make it before the measurements: it refuses a folder of somebody else at once."""

    def __init__(self, target: Path) -> None:
        self.target = Path(os.path.abspath(target))
        _require_replaceable(self.target)

    def write(self, files: dict[str, bytes]) -> None:
        """Write all files and put the folder in place of the last one. On an error nothing changes."""
        partial = self.target.with_name(f".{self.target.name}.partial-{os.getpid()}")
        old = partial.with_name(f"{partial.name}-old")
        try:
            shutil.rmtree(partial, ignore_errors=True)
            partial.mkdir(parents=True)
            for name, content in files.items():
                (partial / name).write_bytes(content)
            (partial / _LIST).write_text("\n".join([_TITLE, *sorted(files)]) + "\n")
            _require_replaceable(self.target)  # what came meanwhile stays as well
            if self.target.exists():
                self.target.rename(old)
            partial.rename(self.target)
        except OSError as error:
            raise error_of(
                "output", f"{self.target}: cannot be written ({error.strerror}); remedy: another folder with --run-dir"
            ) from None
        finally:
            shutil.rmtree(partial, ignore_errors=True)
            if old.exists() and not self.target.exists():
                old.rename(self.target)
            shutil.rmtree(old, ignore_errors=True)
