"""Runs one command and prints what it used: a process of its own, since a child's peak memory counts its parent's.

`python launcher.py FILE COMMAND ...` kills the command once FILE is not empty; with - for FILE it lets it run to its
end. Prints seconds by the wall clock, seconds of the processor, MB at the peak and the exit status. Imports next to
nothing, to stay small itself.
"""

import os
import signal
import sys
import time


def main() -> None:
    """Run the command, wait for its end, and print what it used."""
    file, command = sys.argv[1], sys.argv[2:]
    silent = os.open(os.devnull, os.O_WRONLY)
    began = time.perf_counter()
    child = os.posix_spawnp(command[0], command, os.environ, file_actions=[(os.POSIX_SPAWN_DUP2, silent, 1)])
    if file != "-":
        while not _is_filled(file) and not _has_ended(child):
            time.sleep(0.002)
        clock = time.perf_counter() - began
        os.kill(child, signal.SIGKILL)
    _, status, usage = os.wait4(child, 0)
    if file == "-":
        clock = time.perf_counter() - began
    print(clock, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, os.waitstatus_to_exitcode(status))


def _is_filled(file: str) -> bool:
    try:
        return os.stat(file).st_size > 0  # noqa: PTH116 - pathlib would be more than next to nothing
    except OSError:
        return False


def _has_ended(child: int) -> bool:
    return os.waitid(os.P_PID, child, os.WEXITED | os.WNOHANG | os.WNOWAIT) is not None


if __name__ == "__main__":
    main()
