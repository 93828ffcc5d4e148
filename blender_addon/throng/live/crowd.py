# SPDX-License-Identifier: Apache-2.0
"""What `throng watch` tells of a crowd, as it comes: its people, its moments so far, and how it goes. Pure Python."""
import bisect
import http.client
import json
import struct
import threading

import numpy

_HEAD = 8          # bytes: four letters, and the length of what follows
_NOWHERE = 255     # of levels
_LIFT = 0.3         # m above its floor: over all that is drawn of a layout


class Crowd:
    """One crowd, from its beginning on.

    about: what `throng watch` says of it; frames: of the moments so far; contents: their bytes.
    """

    def __init__(self, about):
        self.about = about
        self.count = len(about["group"])
        self.radii = numpy.asarray(about["radii"], numpy.float32)
        groups = numpy.asarray(about["group"], numpy.int64)
        colours = numpy.array([[int(colour[i:i + 2], 16) / 255 for i in (1, 3, 5)] for colour in about["colours"]] or
                              [[0.5, 0.5, 0.5]], numpy.float32)
        self.colours = colours[groups] if self.count else numpy.empty((0, 3), numpy.float32)
        self.frames, self.contents, self._steps, self._storeys = [], [], [], []
        self._heights = _heights_of(about)

    def add(self, content):
        """Takes a moment's bytes."""
        frame, = struct.unpack_from("<I", content)
        steps = numpy.frombuffer(content, "<u2", 2 * self.count, 4).reshape(self.count, 2)
        self._steps.append(steps)
        self._storeys.append(numpy.frombuffer(content, "u1", self.count, 4 + 4 * self.count))
        self.contents.append(content)
        self.frames.append(frame)

    def at(self, frame):
        """(places, rows): where everybody is who is there then, (k, 3) in metres from the crowd's origin, and who that
        is. Between two moments in straight lines; after the last one as in it."""
        if not self.frames:
            return numpy.empty((0, 3), numpy.float32), numpy.empty(0, numpy.int64)
        last = max(0, bisect.bisect_right(self.frames, frame) - 1)
        following = min(last + 1, len(self.frames) - 1)
        span = self.frames[following] - self.frames[last]
        share = min(1.0, max(0.0, (frame - self.frames[last]) / span)) if span else 0.0
        storeys = self._storeys[last]
        rows = numpy.nonzero(storeys)[0]
        # Whoever is there no more in the next one has its last place in it.
        steps = self._steps[last][rows] * (1.0 - share) + self._steps[following][rows] * share
        places = numpy.empty((len(rows), 3), numpy.float32)
        places[:, :2] = steps * self.about["quantum"] + self.about["minimum"]
        places[:, 2] = self._heights[storeys[rows]]
        return places, rows

    @property
    def end(self):
        """The last frame that there is, or None."""
        return self.frames[-1] if self.frames else None


def _heights_of(about):
    """m, by what a moment says of levels."""
    heights = numpy.full(256, _LIFT, numpy.float32)
    levels = about["geometry"].get("levels", [])
    between = [sum(levels[level]["height"] for level in link["levels"]) / 2
               for link in about["geometry"].get("links", [])]
    for i, height in enumerate([level["height"] for level in levels] + between):
        if i + 1 < _NOWHERE:
            heights[i + 1] += height
    return heights


class Listener:
    """Reads what comes from a `throng watch`, in a thread of its own.

    crowd: the one under way, or None; told: how it goes; changes: counts all that has come; crowds: counts them;
    ended: whether nothing more comes.
    """

    def __init__(self, port):
        self.crowd, self.told, self.changes, self.crowds, self.ended = None, {}, 0, 0, False
        self._port, self._rest, self._stopping = port, b"", False
        self._connection = None
        self._thread = threading.Thread(target=self._listen, daemon=True)

    def start(self):
        self._thread.start()

    def stop(self):
        self._stopping = True
        connection = self._connection
        if connection and connection.sock:
            try:
                connection.sock.shutdown(2)
            except OSError:
                pass
        self._thread.join(5.0)

    def _listen(self):
        try:
            self._connection = http.client.HTTPConnection("127.0.0.1", self._port, timeout=30)
            self._connection.request("GET", "/crowd")
            response = self._connection.getresponse()
            while not self._stopping:
                piece = response.read1(1 << 20)
                if not piece:
                    break
                self.feed(piece)
        except (OSError, http.client.HTTPException, ValueError):
            pass  # it has ended: what there is stays
        finally:
            self.ended = True
            self._connection.close()

    def feed(self, piece):
        """Takes some bytes, wherever they begin and end."""
        self._rest += piece
        at = 0
        while at + _HEAD <= len(self._rest):
            kind, length = self._rest[at:at + 4], struct.unpack_from("<I", self._rest, at + 4)[0]
            if at + _HEAD + length > len(self._rest):
                break
            self._take(kind, self._rest[at + _HEAD:at + _HEAD + length])
            at += _HEAD + length
        self._rest = self._rest[at:]

    def _take(self, kind, content):
        if kind == b"CROW":
            self.crowd = Crowd(json.loads(content))
            self.crowds += 1
        elif kind == b"MOMT":
            self.crowd.add(content)
        elif kind == b"TELL":
            self.told = json.loads(content)
        else:
            return
        self.changes += 1
