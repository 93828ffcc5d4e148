# SPDX-License-Identifier: Apache-2.0
"""Time on a processor, which is the same however busy the machine is. What only is not to hang gets HANGS seconds of a
clock, many times of what it takes."""
import os
import time

HANGS = 300.0


def taken_by(process):
    """Seconds that a child has taken of processors so far; it has not been waited for."""
    with open(f"/proc/{process.pid}/stat", encoding="ascii") as file:
        fields = file.read().rpartition(")")[2].split()
    return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")


def taken_by_children():
    """Of all that have been waited for."""
    times = os.times()
    return times.children_user + times.children_system


def let_work(process, seconds):
    """Comes back once it has taken so much of processors. Returns whether it is still at work."""
    end = time.monotonic() + HANGS
    while process.poll() is None and (left := seconds - taken_by(process)) > 0.0:
        assert time.monotonic() < end, f"it hangs {left} s before"
        time.sleep(max(0.5 * left, 0.002))  # it may be at work on two of them
    return process.poll() is None
