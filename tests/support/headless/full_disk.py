"""A disk on which little fits, and a limit for the size of files: real ones."""

import os
import resource
import subprocess
from contextlib import contextmanager, suppress

DISK_BYTES = 2**22


@contextmanager
def file_limit(n_bytes):
    """Let this process write no file beyond a size; works for every user."""
    before = resource.getrlimit(resource.RLIMIT_FSIZE)
    resource.setrlimit(resource.RLIMIT_FSIZE, (n_bytes, before[1]))
    try:
        yield
    finally:
        resource.setrlimit(resource.RLIMIT_FSIZE, before)


@contextmanager
def full_disk(folder):
    """Make `folder` a small disk; yield a function that leaves only some bytes free.

    The function is a context manager, and gives the sentence to expect. Who must not
    mount a disk gets a limit for the size of files.
    """
    command = ["mount", "-t", "tmpfs", "-o", f"size={DISK_BYTES}", "tmpfs", folder]
    with suppress(OSError):
        if subprocess.run(command, capture_output=True).returncode == 0:
            try:
                yield lambda n_bytes: _filled(folder, n_bytes)
            finally:
                subprocess.run(["umount", "-l", folder], check=True)
            return
    yield _limited


@contextmanager
def _limited(n_bytes):
    with file_limit(n_bytes):
        yield "File too large"


@contextmanager
def _filled(folder, n_bytes):
    filler = folder / "filler"
    disk = os.statvfs(folder)
    filler.write_bytes(b"x" * (disk.f_bavail * disk.f_bsize - n_bytes // 4096 * 4096))
    try:
        yield "No space left on device"
    finally:
        filler.unlink()
