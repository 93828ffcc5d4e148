# SPDX-License-Identifier: Apache-2.0
"""Runs the program and keeps what was measured, by a hash of program, layout, settings and machine."""

import hashlib
import inspect
import json
import os
import pathlib
import platform
import shutil
import subprocess
import sys
import tempfile
import threading
import time
from unittest import mock

import reading

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent
QUICK_SECONDS = 3


def output_of(*command):
    return subprocess.run([str(word) for word in command], check=True, stdout=subprocess.PIPE, text=True).stdout


def on_one_core():
    """While it lasts, programs do without the software renderer's threads."""
    return mock.patch.dict(os.environ, {"LP_NUM_THREADS": "0"})


def processor():
    for line in pathlib.Path("/proc/cpuinfo").read_text().splitlines():
        if line.startswith("model name"):
            return line.partition(":")[2].strip()
    return platform.processor() or "unknown processor"


def commit():
    """What the checkout is at. Pages and what is made do not count as changes: this writes them."""
    try:
        name = output_of("git", "-C", ROOT, "rev-parse", "--short", "HEAD").strip()
        changed = output_of("git", "-C", ROOT, "status", "--porcelain", "--", ":/", ":(exclude,top)docs")
    except (OSError, subprocess.CalledProcessError):
        return "an unknown commit"
    return f"commit {name}" + (" (dirty)" if changed.strip() else "")


class Runs:
    def __init__(self, program, folder, docs, quick):
        """@param folder where results are kept; bakes are only there while they are read"""
        self.program, self.folder, self.docs, self.quick = pathlib.Path(program).resolve(), folder, docs, quick
        self.folder.mkdir(parents=True, exist_ok=True)
        self.being_made = {}  # a lock for each result: tables made at once share some
        self.program_hash = hashlib.sha256(self.program.read_bytes()).hexdigest()
        devices = json.loads(output_of(self.program, "devices", "--json"))
        usable = [device for device in devices if device["usable"]]
        if not usable:
            raise SystemExit("no device here can bake: throng devices")
        self.device = usable[0]
        self.machine = f"{processor()}, {os.cpu_count()} cores; {self.device['name']}, {self.device['version']}"

    def stamp(self, name):
        shortened = " A quick trial, good for nothing else." if self.quick else ""
        return (
            f"Made by `scripts/figures {name}`: {commit()}, program {self.program_hash[:8]}; {self.machine}.{shortened}"
        )

    def seeds(self, count):
        return [1] if self.quick else list(range(1, count + 1))

    def known(self, what, make, *inputs):
        """make() once for the same program, machine and inputs (paths count by what is in them).

        @param what what is being done, for people to read
        """
        key = hashlib.sha256(f"{self.program_hash} {self.machine}".encode())
        for thing in inputs:
            key.update(thing.read_bytes() if isinstance(thing, pathlib.Path) else repr(thing).encode())
        path = self.folder / f"{key.hexdigest()[:24]}.json"
        with self.being_made.setdefault(path, threading.Lock()):
            if not path.exists():
                self.measure(what, make, path)
            return json.loads(path.read_text())["result"]

    def measure(self, what, make, path):
        start = time.monotonic()
        result = make()
        seconds = time.monotonic() - start
        print(f"  {what}: {seconds:.0f} s", file=sys.stderr, flush=True)
        complete = path.with_suffix(".new")
        complete.write_text(
            json.dumps({"what": what, "commit": commit(), "seconds": round(seconds, 1), "result": result})
        )
        complete.rename(path)

    def scenario(self, name, *settings, read=None):
        """What `throng scenarios --json` prints of it, and what `read` (of the bake's folder) finds besides."""
        read = read or reading.OF.get(name)
        if self.quick:
            settings = (*settings, f"simulation.duration={QUICK_SECONDS}")

        def bake():
            with tempfile.TemporaryDirectory(dir=self.folder) as scratch:
                words = [word for setting in settings for word in ("--set", setting)]
                command = [self.program, "scenarios", "--run", name, "--json", "-o", scratch, *words]
                done = subprocess.run(
                    command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True, check=False
                )
                if done.returncode not in (0, 1):  # 1: a bar is missed
                    raise SystemExit(f"{' '.join(map(str, command))} ended with {done.returncode}")
                figures = json.loads(done.stdout)
                return {**figures, **(read(pathlib.Path(scratch) / name) if read else {})}

        source = inspect.getsource(read) if read else ""
        described = " ".join([name, *settings])
        return self.known(described, bake, "scenario", name, settings, source)

    def layout(self, name):
        """A scenario's layout, as in this checkout."""
        folders = (ROOT / "scenarios", ROOT / "scenarios" / "large")
        path = next(folder / f"{name}.json" for folder in folders if (folder / f"{name}.json").exists())
        return json.loads(path.read_text())

    def scratch(self, name):
        """An empty folder of this name that stays for looking at."""
        folder = self.folder.parent / name
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir(parents=True)
        return folder
