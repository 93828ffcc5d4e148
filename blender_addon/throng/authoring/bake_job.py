# SPDX-License-Identifier: Apache-2.0
"""`throng bake` in the background: started, asked now and then how far it is, cancelled. Pure Python, no Blender."""
import atexit
import collections
import json
import os
import re
import shutil
import signal
import subprocess
import threading
import time

_DIAGNOSTIC = re.compile(r"(?P<file>.*?)(?::(?P<line>\d+):(?P<column>\d+))?: (?P<severity>error|warning): "
                         r"(?:(?P<pointer>/.*?): )?(?P<message>.*)")
_PATIENCE = 20.0  # s from SIGINT to SIGKILL
_AGAIN = 4.0      # s from one SIGINT to the next
INVALID = 3       # exit code

Diagnostic = collections.namedtuple("Diagnostic", "severity pointer message hint line column")


def parse_diagnostics(text):
    """What the program says about a layout: [Diagnostic], from its lines `file:line:column: error: /pointer:
    message` and their hints."""
    result = []
    for line in text.splitlines():
        if line.startswith("  hint: ") and result:
            result[-1] = result[-1]._replace(hint=line[8:])
        found = None if line.startswith(" ") else _DIAGNOSTIC.fullmatch(line)
        if found:
            result.append(Diagnostic(found["severity"], found["pointer"] or "", found["message"], "",
                                     int(found["line"] or 0), int(found["column"] or 0)))
    return result


def check_layout(executable, path):
    """What is wrong with a layout, without baking it: (valid, [Diagnostic], all that was said)."""
    done = subprocess.run([executable, "check", path], capture_output=True, text=True, check=False)
    return done.returncode == 0, parse_diagnostics(done.stderr), (done.stderr + done.stdout).strip()


class BakeJob:
    """One bake. `poll()` never waits. The bake appears at `output` complete or not at all; a cancelled
    one leaves nothing behind.

    state: new, running, done, cancelled or failed; percent, frame, frames, people, seconds_left as the program tells
    them; result, the manifest of a bake that is done; diagnostics and message when there is something to say.
    """

    def __init__(self, executable, layout, output, options=()):
        self.command = [executable, "bake", layout, "-o", output, "--json", "--force", "--checkpoint", "0", *options]
        self.output = output
        self.state = "new"
        self.percent, self.frame, self.frames, self.people, self.seconds_left = 0.0, 0, 0, 0, None
        self.result, self.diagnostics, self.message, self.code = None, [], "", None
        self._process, self._said, self._readers = None, {"stdout": [], "stderr": []}, []
        self._lock = threading.Lock()
        self._cancelled_at = self._told_at = None
        self._before = frozenset()

    def start(self):
        self._before = frozenset(self._leftovers())
        try:
            self._process = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                             stderr=subprocess.PIPE, text=True, errors="replace")
        except OSError as error:
            self.state, self.message = "failed", f"{self.command[0]} does not run: {error.strerror}"
            return
        self.state = "running"
        self._readers = [threading.Thread(target=self._read, args=(name,), daemon=True) for name in self._said]
        for reader in self._readers:
            reader.start()
        atexit.register(self.stop)

    def _read(self, name):
        """Runs in a thread of its own: a full pipe would stop the program."""
        for line in getattr(self._process, name):
            progress = self._progress(line) if name == "stderr" else None
            with self._lock:
                if progress is None:
                    self._said[name].append(line)
                else:
                    self.percent, self.frame, self.frames = progress["progress"], progress["frame"], progress["frames"]
                    self.people, self.seconds_left = progress["agents"], progress["eta_seconds"]

    @staticmethod
    def _progress(line):
        if not line.startswith('{"progress"'):
            return None
        try:
            return json.loads(line)
        except ValueError:
            return None

    def poll(self):
        """Looks how far it is, and returns the state."""
        if self.state != "running":
            return self.state
        if self._process.poll() is None:
            self._insist()
            return self.state
        self._finish()
        return self.state

    def wait(self, timeout=None):
        """Until it has ended, or the time is over; returns the state."""
        until = None if timeout is None else time.monotonic() + timeout
        while self.poll() == "running" and (until is None or time.monotonic() < until):
            try:
                self._process.wait(0.2 if until is None else min(0.2, max(0.0, until - time.monotonic())))
            except subprocess.TimeoutExpired:
                continue
        return self.poll()

    def cancel(self):
        """Asks the program to stop; poll() says `cancelled` once it has. A bake that ends before it hears
        of it counts as done."""
        if self.state == "running" and self._cancelled_at is None:
            self._cancelled_at = self._told_at = time.monotonic()
            if self._process.poll() is None:
                self._process.send_signal(signal.SIGINT)

    def _insist(self):
        """A program that has only just begun may not have heard: where interrupts are ignored (in background jobs of a
        shell, say), it begins to listen only when it has begun."""
        now = time.monotonic()
        if self._cancelled_at is None:
            return
        if now - self._cancelled_at > _PATIENCE:
            self._process.kill()
        elif now - self._told_at > _AGAIN:
            self._told_at = now
            self._process.send_signal(signal.SIGINT)

    def stop(self):
        """Cancels and waits: for when Blender closes."""
        if self.state == "running":
            self.cancel()
            if self.wait(5.0) == "running":
                self._process.kill()
                self.wait()

    def _finish(self):
        for reader in self._readers:
            reader.join()
        for pipe in (self._process.stdout, self._process.stderr):
            pipe.close()
        atexit.unregister(self.stop)
        self.code = self._process.returncode
        errors = "".join(self._said["stderr"])
        self.diagnostics = parse_diagnostics(errors)
        if self.code == 0:
            try:
                self.result = json.loads("".join(self._said["stdout"]))
            except ValueError:
                self.state = "failed"
                self.message = f"{self.command[0]} did not describe its bake: is it of another version?"
                return
            self.state, self.percent = "done", 100.0
            return
        self._tidy()
        if self._cancelled_at is not None:
            self.state, self.message = "cancelled", "the bake was cancelled"
            return
        self.state, self.message = "failed", self._reason(errors)

    def _reason(self, errors):
        wrong = [entry for entry in self.diagnostics if entry.severity == "error"]
        if wrong:
            more = f" (and {len(wrong) - 1} more)" if len(wrong) > 1 else ""
            return wrong[0].message + more
        lines = [line for line in errors.splitlines() if line.strip()]
        if self.code < 0:
            return f"throng was ended by signal {-self.code}"
        return lines[-1].removeprefix("throng: ") if lines else f"throng ended with exit code {self.code}"

    def _leftovers(self):
        """What an unfinished bake leaves beside its output, by name and identity."""
        folder, name = os.path.split(os.path.abspath(self.output))
        try:
            entries = [entry for entry in os.scandir(folder)
                       if re.fullmatch(re.escape(name) + r"\.(partial(-\d+)?|unfinished|tmp-\w+)", entry.name)]
        except OSError:
            return []
        return [(entry.path, entry.inode()) for entry in entries]

    def _tidy(self):
        for path, identity in self._leftovers():
            if (path, identity) not in self._before:
                shutil.rmtree(path, ignore_errors=True)
