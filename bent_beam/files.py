"""Files that are whole or not there."""

from __future__ import annotations

import os
import shutil
import tempfile
from pathlib import Path
from typing import BinaryIO

__all__ = ["write_atomically"]


def write_atomically(file: Path, content: str | bytes | memoryview | BinaryIO) -> None:
    """Write a file so that a reader sees either nothing or all of it, and a killed run leaves no half of it.

    Raises ``OSError`` that names the file: a full disk does not say by itself which one it could not take.
    """
    file.parent.mkdir(parents=True, exist_ok=True)
    handle, name = tempfile.mkstemp(prefix=f".{file.name[:100]}.", suffix=".part", dir=file.parent)
    try:
        with os.fdopen(handle, "wb") as part:
            if isinstance(content, (str, bytes, memoryview)):
                part.write(content.encode() if isinstance(content, str) else content)
            else:
                shutil.copyfileobj(content, part)
            part.flush()
            os.fsync(part.fileno())
        os.chmod(name, 0o644)
        os.replace(name, file)
    except OSError as error:
        raise OSError(error.errno, error.strerror or str(error), str(file)) from error
    finally:
        Path(name).unlink(missing_ok=True)
