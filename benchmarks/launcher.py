"""Runs one command and prints what it took; a process of its own, since a child's peak of memory counts its parent's.

`python launcher.py FILE COMMAND ...`: stops the command once FILE holds something; FILE may be -, then it runs to its
end. Prints seconds by the clock, seconds of the processor, MB at the peak and the exit status. Imports next to nothing.
"""

import os
import signal
import sys
import time


def main() -> None:
    """Run, wait, print."""
    file, command = sys.argv[1], sys.argv[2:]
    silent = os.open(os.devnull, os.O_WRONLY)
    began = time.perf_counter()
    child = os.posix_spawnp(command[0], command, os.environ, file_actions=[(os.POSIX_SPAWN_DUP2, silent, 1)])
    if file != "-":
        while not _holds_something(file) and not _is_over(child):
            time.sleep(0.002)
        clock = time.perf_counter() - began
        os.kill(child, signal.SIGKILL)
    _, status, usage = os.wait4(child, 0)
    if file == "-":
        clock = time.perf_counter() - began
    print(clock, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, os.waitstatus_to_exitcode(status))


def _holds_something(file: str) -> bool:
    try:
        return os.stat(file).st_size > 0  # noqa: PTH116 - pathlib is more than next to nothing
    except OSError:
        return False


def _is_over(child: int) -> bool:
    return os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None


if __name__ == "__main__":
    main()
