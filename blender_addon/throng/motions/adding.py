# SPDX-License-Identifier: Apache-2.0
"""From a source of clips to the motions of a crowd's cast, with a report of what became of what."""
from ..cast.gait import RUNNING_STRIDE
from ..characters import CharacterError, roles
from ..crowd.queries import cast_of, members_of
from . import MotionError, members, reading, sources

SLIDES = 0.02  # m a step: more is worth a warning


class Options:
    """What a user says; empty or zero is found automatically."""

    def __init__(self, role="", clip="", chosen="", every=False, feet=(), height=0.0):
        self.role, self.clip, self.chosen, self.every = role, clip, chosen, every
        self.feet, self.height = feet, height


def numbers_of(text, what="members"):
    """"0, 3-5" as [0, 3, 4, 5]."""
    found = []
    for part in (part.strip() for part in text.split(",") if part.strip()):
        first, _, last = part.partition("-")
        if not (first.strip().isdigit() and (last.strip() or first.strip()).isdigit()):
            raise MotionError(f"{what}: {part!r} is no number of somebody: write 0, 3-5")
        ends = int(first), int(last or first)
        if ends[1] < ends[0] or ends[1] > 999:
            raise MotionError(f"{what}: {part} should go from a lower number to a higher one, below 1000")
        found += range(ends[0], ends[1] + 1)
    return list(dict.fromkeys(found))


def who(crowd, text):
    """(members who are given the motion, notes about the others). Raises MotionError."""
    cast, count = cast_of(crowd), len(members_of(crowd))
    movable, asked = members.movable(cast), numbers_of(text)
    if not movable:
        raise MotionError("nobody in this crowd can be given motions: people can who are shaped from a library of "
                          "bodies (scripts/body_library.py)")
    for number in asked:
        if number >= count:
            raise MotionError(f"the cast has members 0 to {count - 1}: there is no {number}")
        if number not in movable:
            raise MotionError(f"member {number} is not shaped from a body: characters of your own bring their own "
                              "clips")
    chosen = asked or movable
    sticks = members.with_sticks(cast, chosen)
    chosen = [number for number in chosen if number not in sticks]
    if not chosen:
        raise MotionError("all these members walk with a stick: they keep their own walk")
    notes = [f"{_listed(sticks)} walk with a stick: they keep their own motion"] if sticks else []
    return chosen, notes


def _listed(numbers):
    return f"member{'s' if len(numbers) > 1 else ''} {', '.join(map(str, numbers))}"


def _by_motion(take, z_up, options):
    """(Motion, role, report) of a clip of which no name says what it is for: it walks, or stands."""
    why = []
    for read, role in ((reading.walk_of, roles.WALK), (reading.stand_of, roles.IDLE)):
        body = reading.body_of(take, options.feet, options.height, z_up)
        try:
            return read(body), role, body.report
        except MotionError as error:
            why.append(str(error))
    raise MotionError("; ".join(why))


def _read(source, clip, role, options):
    take = source.take(clip)
    role = options.role or role
    if not role:
        return _by_motion(take, source.z_up, options)
    body = reading.body_of(take, options.feet, options.height, source.z_up)
    if role in sources.WALKS:
        return reading.walk_of(body), roles.WALK, body.report
    return reading.stand_of(body), role, body.report


def _motions(source, options):
    """[(Motion, role, report)] of the clips that are taken, and what is said of those that are not."""
    wanted = source.chosen(options.clip)
    if options.role and not options.clip:
        fitting = [each for each in wanted if each[1] == options.role] or wanted
        wanted = fitting[:1] if all(role for _, role in fitting) else fitting
    found, refused = [], []
    for clip, role in wanted:
        try:
            found.append(_read(source, clip, role, options))
        except CharacterError as error:
            refused.append(error)
        if found and not role:
            break  # of clips that nobody has named the first that goes
    if not found:
        if len(refused) == 1:
            raise refused[0]
        raise MotionError(f"{source.name}: none of its clips can be used: {'; '.join(map(str, refused[:4]))}")
    return found, [f"not used: {error}" for error in refused]


def add(crowd, source, options, progress=lambda share: None):
    """Gives the clips of a source to members of a crowd's cast. Returns (lines, warnings); raises CharacterError, or
    LibraryError, before anything is changed."""
    chosen, notes = who(crowd, options.chosen)
    motions, refused = _motions(source, options)
    batch = members.next_batch(cast_of(crowd))
    entries = [members.Entry(motion, role, tuple(chosen), options.every, batch, report.lines + report.notes)
               for motion, role, report in motions]
    shown = members.add(crowd, entries, progress)
    lines, warnings = [], []
    for entry, (_, _, report) in zip(entries, motions):
        lines += [*report.lines, *_became(entry, shown), *report.notes]
        worst = max((slid for each in shown.values() for one, _, _, slid in each.gaits if one is entry), default=0.0)
        if worst > SLIDES:
            warnings.append(f"{entry.name}: feet slide by up to {100.0 * worst:.1f} cm a step")
    return lines + notes + refused, warnings


def _became(entry, shown):
    """What a motion is taken for, in lines."""
    many = f"of {len(shown)} member{'s' if len(shown) > 1 else ''}"
    clips = members.stands_for(entry.role)
    if clips:
        return [f"{entry.name}: is how they stand ({', '.join(clips)}) {many}"]
    taken = {}
    for each in shown.values():
        for one, stride, share, slid in each.gaits:
            if one is entry:
                taken.setdefault(stride, []).append((share, slid))
    if not taken:
        return [f"{entry.name}: another clip is nearer to all strides of this crowd: it is not shown"]
    return [line for stride in sorted(taken) for line in _of_stride(entry, stride, taken[stride], many)]


def _of_stride(entry, stride, taken, many):
    """@param taken [(share of the cycle that feet are planted, m that slides in a step)] of all members"""
    least, most = (100.0 * end(share for share, _ in taken) for end in (min, max))
    yield (f"stride {stride:.2f} m: {entry.name} (its own: {entry.motion.stride:.2f} m) {many}, planted {least:.0f} to "
           f"{most:.0f} %, slides {100.0 * max(slid for _, slid in taken):.1f} cm a step at most")
    if (stride >= RUNNING_STRIDE) != (entry.motion.stride >= RUNNING_STRIDE):
        yield f"stride {stride:.2f} m: the cast's own {'runs' if stride >= RUNNING_STRIDE else 'walks'}"
