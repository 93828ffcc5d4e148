# SPDX-License-Identifier: Apache-2.0
"""Runs a command and tells what its parts took: of a clock, and of processors by thread."""

import json
import os
import pathlib
import subprocess
import sys
import threading
import time

FRAMES_THREAD = "throng-frames"  # of a bake: records and writes, beside the one that steps
TICKS = os.sysconf("SC_CLK_TCK")


def seconds_of(task):
    fields = (task / "stat").read_text().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / TICKS


class ThreadTimes(threading.Thread):
    """Processor time of the frames thread, as it was when it was last seen."""

    def __init__(self, process):
        super().__init__(daemon=True)
        self.process, self.frames = process, 0.0

    def run(self):
        tasks = pathlib.Path(f"/proc/{self.process.pid}/task")
        while self.process.returncode is None:
            try:
                for task in tasks.iterdir():
                    if (task / "comm").read_text().strip() == FRAMES_THREAD:
                        self.frames = max(self.frames, seconds_of(task))
            except OSError:
                pass  # it has ended meanwhile
            time.sleep(0.02)


def watched(command):
    """Its seconds of a clock and of processors (with all that it starts), its most memory in MiB; of a command that
    tells its progress as JSON, when the first frame was there and when the last one, and what the frames' thread took.
    """
    start, marks = time.monotonic(), []
    before = os.times()
    with subprocess.Popen(
        [str(word) for word in command], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True
    ) as process:
        threads = ThreadTimes(process)
        threads.start()
        for line in process.stderr:
            if line.startswith("{") and "frame" in json.loads(line):
                marks.append(time.monotonic() - start)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        threads.join()
    if process.returncode != 0:
        raise SystemExit(f"{' '.join(map(str, command))} ended with {process.returncode}")
    after = os.times()
    return {
        "wall": time.monotonic() - start,
        "processor": after.children_user + after.children_system - before.children_user - before.children_system,
        "memory": usage.ru_maxrss / 1024.0,
        "frames": threads.frames,
        "first": marks[0] if marks else None,
        "last": marks[-1] if marks else None,
    }


def watch(command):
    """The same, by a process that needs next to nothing itself: the system begins to count a command's most memory with
    what its parent had."""
    words = [sys.executable, __file__, *(str(word) for word in command)]
    return json.loads(subprocess.run(words, check=True, stdout=subprocess.PIPE, text=True).stdout)


if __name__ == "__main__":
    print(json.dumps(watched(sys.argv[1:])))
