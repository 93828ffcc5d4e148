# SPDX-License-Identifier: Apache-2.0
"""`throng watch` in the background. Pure Python, no Blender."""
import atexit
import json
import signal
import subprocess
import threading

from .crowd import Listener

_PATIENCE = 5.0  # s, for its end


class WatchJob:
    """One `throng watch` and what it tells. Never waits but in stop().

    listener: None until it has said where it listens; message: why it came to nothing.
    """

    def __init__(self, executable, path, options=()):
        self.command = [executable, "watch", str(path), "--json", *options]
        self.listener, self.message = None, ""
        self._process, self._errors, self._readers = None, [], []

    def start(self):
        try:
            self._process = subprocess.Popen(self.command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                             stderr=subprocess.PIPE, text=True, errors="replace")
        except OSError as error:
            self.message = f"{self.command[0]} does not run: {error.strerror}"
            return
        self._readers = [threading.Thread(target=each, daemon=True) for each in (self._read_output, self._read_errors)]
        for reader in self._readers:
            reader.start()
        atexit.register(self.stop)

    def _read_output(self):
        for line in self._process.stdout:
            try:
                port = json.loads(line)["port"]
            except (ValueError, KeyError, TypeError):
                continue
            listener = Listener(port)
            listener.start()
            self.listener = listener

    def _read_errors(self):
        for line in self._process.stderr:
            self._errors = self._errors[-50:] + [line.rstrip()]

    @property
    def crowd(self):
        return self.listener.crowd if self.listener else None

    @property
    def told(self):
        return self.listener.told if self.listener else {}

    def is_running(self):
        """Whether it goes on; where it does not, `message` says why."""
        if self._process is None:
            return False
        if self._process.poll() is None:
            return True
        if not self.message:
            lines = [line for line in self._errors if line]
            self.message = lines[-1].replace("throng: ", "", 1) if lines else \
                f"throng ended with exit code {self._process.returncode}"
        return False

    def stop(self):
        """Ends it, and waits for that."""
        if self._process is None:
            return
        if self._process.poll() is None:
            self._process.send_signal(signal.SIGINT)
            try:
                self._process.wait(_PATIENCE)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        if self.listener:
            self.listener.stop()
        for reader in self._readers:
            reader.join(1.0)
        for pipe in (self._process.stdout, self._process.stderr):
            pipe.close()
        atexit.unregister(self.stop)
        self._process = None
