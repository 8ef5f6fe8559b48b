"""Run computations in other processes of Python, which know nothing of Blender.

Threads would wait for each other: Python runs one at a time. The processes are plain
Python with this package and its libraries; Blender is in none of them.
"""

from __future__ import annotations

import contextlib
import os
import pickle
import queue
import subprocess
import sys
import threading
import time
from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field
from hashlib import blake2b
from pathlib import Path
from typing import IO, Any

from ..errors import DecompositionError
from .memo import Memo
from .progress import Progress, Steps, T, run

# More processes hardly help: one process writes what the others compute.
_MOST = 8
# Time between two reports of progress.
_SECONDS = 0.05
# So many answers are kept for equal calls.
_ANSWERS = 256
_PACKAGE = __name__.rpartition(".core.")[0]
_ROOT = str(Path(__file__).resolve().parents[2])
# What a process does. Inside Blender, the package is below others that Blender makes.
_PROGRAM = """
import pickle, signal, sys, types
from importlib.util import module_from_spec, spec_from_file_location
signal.signal(signal.SIGINT, signal.SIG_IGN)
sys.path[:], name, root = pickle.load(sys.stdin.buffer)
above = name.split(".")[:-1]
for n in range(len(above)):
    outer = types.ModuleType(".".join(above[: n + 1]))
    outer.__path__ = []
    sys.modules[outer.__name__] = outer
spec = spec_from_file_location(
    name, root + "/__init__.py", submodule_search_locations=[root]
)
sys.modules[name] = package = module_from_spec(spec)
spec.loader.exec_module(package)
__import__(name + ".core.steps.processes", fromlist=["serve"]).serve()
"""


def serve() -> None:
    """Answer the calls that come from standard input, until it ends.

    Before each answer come reports of progress, as the calls give them.
    """
    calls, answers = sys.stdin.buffer, sys.stdout.buffer
    sys.stdout = sys.stderr  # nothing else is to be written among the answers
    with contextlib.suppress(EOFError, BrokenPipeError):
        while True:
            compute, arguments = pickle.load(calls)
            answer: tuple[Any, str | None]
            try:
                answer = run(compute(*arguments), _teller(answers)), None
            except DecompositionError as error:
                answer = None, str(error)
            _send(answer, answers)


def _teller(answers: IO[bytes]) -> Callable[[Progress], None]:
    """Return what sends progress now and then."""
    sent = time.monotonic()

    def tell(progress: Progress) -> None:
        nonlocal sent
        if time.monotonic() > sent + _SECONDS:
            _send(progress, answers)
            sent = time.monotonic()

    return tell


def _send(value: Any, answers: IO[bytes]) -> None:
    """Send a value to the process that asks."""
    pickle.dump(value, answers, pickle.HIGHEST_PROTOCOL)
    answers.flush()


def available() -> int:
    """Return how many processes to start: one for each processor, up to a limit."""
    if hasattr(os, "sched_getaffinity"):  # not on macOS and Windows
        return min(len(os.sched_getaffinity(0)), _MOST)
    return min(os.cpu_count() or 1, _MOST)


@dataclass
class _Call:
    """A computation in another process.

    Attributes
    ----------
    progress : Progress
        The latest report.
    answer : Future
        Of its value and its error, or None without an answer.
    """

    progress: Progress
    answer: Future[Any] = field(init=False)


class Processes:
    """Processes that compute one thing each at a time.

    Each starts when it is needed first. Where one cannot start, or ends for want of
    memory, this process computes.

    Parameters
    ----------
    count : int
        Number of processes.
    """

    def __init__(self, count: int) -> None:
        self._threads = ThreadPoolExecutor(count)  # they wait for answers
        self._starting = threading.Lock()
        self._started: list[subprocess.Popen[bytes]] = []
        self._left = count  # how many may still be started
        self._calls: Memo[bytes, _Call] = Memo(_ANSWERS)
        self._idle: queue.SimpleQueue[subprocess.Popen[bytes]] = queue.SimpleQueue()

    def steps(
        self, stage: str, compute: Callable[..., Steps[T]], *arguments: Any
    ) -> Steps[T]:
        """Start a computation at once; return steps that wait for its value.

        A call that equals one of the latest gets the same answer.

        Parameters
        ----------
        stage : str
            What the steps report until the process does, in words for the user.
        compute : callable
            A function of a module in the core; returns steps.
        *arguments
            What can be pickled.

        Returns
        -------
        Steps

        Raises
        ------
        DecompositionError
            By the steps, if the computation raises it.
        """
        call = pickle.dumps((compute, arguments), pickle.HIGHEST_PROTOCOL)
        begun = self._calls.recall(
            blake2b(call).digest(), lambda: self._begin(call, stage)
        )
        return _waiting(begun, compute, arguments)

    def close(self) -> None:
        """End all processes, whatever they do."""
        with self._starting:
            self._left = 0
        for process in self._started:
            process.kill()
        self._threads.shutdown(cancel_futures=True)
        for process in self._started:
            process.communicate()

    def _begin(self, pickled: bytes, stage: str) -> _Call:
        """Begin a computation."""
        call = _Call(Progress(stage, 0.0))
        call.answer = self._threads.submit(self._answer, pickled, call)
        return call

    def _answer(self, pickled: bytes, call: _Call) -> Any:
        """Return the value and the error of a computation, None without an answer."""
        try:
            process = self._free()
            assert process.stdin is not None
            assert process.stdout is not None
            process.stdin.write(pickled)
            process.stdin.flush()
            while isinstance(answer := pickle.load(process.stdout), Progress):
                call.progress = answer
        except (OSError, EOFError, queue.Empty, pickle.UnpicklingError):
            return None
        self._idle.put(process)
        return answer

    def _free(self) -> subprocess.Popen[bytes]:
        """Return a process that is idle, or a new one; there is one for each thread."""
        with contextlib.suppress(queue.Empty):
            return self._idle.get_nowait()
        with self._starting:
            if self._left == 0:
                raise queue.Empty
            self._left -= 1
            process = _start()
            self._started.append(process)
        assert process.stdin is not None
        pickle.dump((sys.path, _PACKAGE, _ROOT), process.stdin)
        return process


def _start() -> subprocess.Popen[bytes]:
    """Start a process."""
    names = ("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS")
    return subprocess.Popen(
        # -P keeps modules of the current folder out, such as a pickle.py of the user's.
        [sys.executable or "", "-P", "-c", _PROGRAM],
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        stderr=subprocess.DEVNULL,
        env={**os.environ, **dict.fromkeys(names, "1")},
        start_new_session=True,  # Ctrl-C is for this process, which ends the others
        creationflags=getattr(subprocess, "CREATE_NO_WINDOW", 0),  # on Windows
    )


def _waiting(
    call: _Call,
    compute: Callable[..., Steps[T]],
    arguments: tuple[Any, ...],
) -> Steps[T]:
    """Wait for the answer to a call; compute here if there is none."""
    while not call.answer.done():
        yield call.progress
        with contextlib.suppress(TimeoutError):
            call.answer.exception(_SECONDS)
    found = call.answer.result()
    if found is None:
        return (yield from compute(*arguments))
    value, error = found
    if error is not None:
        raise DecompositionError(error)
    return value
