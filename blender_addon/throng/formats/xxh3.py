# SPDX-License-Identifier: Apache-2.0
"""XXH3, 64 bits, seed 0, of files: what bake.json lists. Blender comes with numpy and without a library for it."""
import os

import numpy

_MASK = (1 << 64) - 1
_PRIME32 = (0x9E3779B1, 0x85EBCA77, 0xC2B2AE3D)
_PRIME64 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5)
_MIX = (0x165667919E3779F9, 0x9FB21C651E98DF25)
# The secret of the format, which is part of its definition.
_SECRET = bytes.fromhex(
    "b8fe6c3923a44bbe7c01812cf721ad1cded46de9839097db7240a4a4b7b3671fcb79e64eccc0e578825ad07dccff7221b8084674f743248e"
    "e03590e6813a264c3c2852bb91c300cb88d0658b1b532ea371644897a20df94e3819ef46a9deacd8a8fa763fe39c343ff9dcbbc7c70b4f1d"
    "8a51e04bcdb45931c89f7ec9d9787364eac5ac8334d3ebc3c581a0fffa1363eb170ddd51b7f0da49d316552629d4689e2b16be587d47a1fc"
    "8ff8b8d17ad031ce45cb3a8f95160428afd7fbcabb4b407e")
_STRIPE, _STRIPES, _BLOCK = 64, 16, 1024
_PIECE = 1 << 20  # bytes read at a time: whole blocks


def _word(data, at, size=8):
    return int.from_bytes(data[at:at + size], "little")


def _secret_word(at, size=8):
    return _word(_SECRET, at, size)


def _lanes(at):
    return numpy.frombuffer(_SECRET, "<u8", 8, at)


_KEYS = numpy.stack([_lanes(8 * stripe) for stripe in range(_STRIPES)])
_SCRAMBLE, _LAST = _lanes(len(_SECRET) - _STRIPE), _lanes(len(_SECRET) - _STRIPE - 7)
_START = numpy.array([_PRIME32[2], *_PRIME64[:4], _PRIME32[1], _PRIME64[4], _PRIME32[0]], "<u8")
_SWAPPED = [1, 0, 3, 2, 5, 4, 7, 6]


def _folded(a, b):
    product = a * b
    return (product & _MASK) ^ (product >> 64)


def _avalanche(value):
    value &= _MASK
    value = ((value ^ value >> 37) * _MIX[0]) & _MASK
    return value ^ value >> 32


def _old_avalanche(value):
    value = ((value ^ value >> 33) * _PRIME64[1]) & _MASK
    value = ((value ^ value >> 29) * _PRIME64[2]) & _MASK
    return value ^ value >> 32


def _rotated(value, bits):
    return (value << bits | value >> 64 - bits) & _MASK


def _mixed(data, at, secret):
    return _folded(_word(data, at) ^ _secret_word(secret), _word(data, at + 8) ^ _secret_word(secret + 8))


def _to_16(data):
    size = len(data)
    if size > 8:
        low = _word(data, 0) ^ _secret_word(24) ^ _secret_word(32)
        high = _word(data, size - 8) ^ _secret_word(40) ^ _secret_word(48)
        return _avalanche(size + int.from_bytes(low.to_bytes(8, "little"), "big") + high + _folded(low, high))
    if size > 3:
        value = (_word(data, size - 4, 4) + (_word(data, 0, 4) << 32)) ^ _secret_word(8) ^ _secret_word(16)
        value = ((value ^ _rotated(value, 49) ^ _rotated(value, 24)) * _MIX[1]) & _MASK
        value = ((value ^ (value >> 35) + size) * _MIX[1]) & _MASK
        return value ^ value >> 28
    if size > 0:
        value = data[0] << 16 | data[size >> 1] << 24 | data[size - 1] | size << 8
        return _old_avalanche(value ^ _secret_word(0, 4) ^ _secret_word(4, 4))
    return _old_avalanche(_secret_word(56) ^ _secret_word(64))


def _to_240(data):
    size = len(data)
    total = size * _PRIME64[0]
    if size <= 128:
        for i in range((size - 1) // 32 + 1):
            total += _mixed(data, 16 * i, 32 * i) + _mixed(data, size - 16 * (i + 1), 32 * i + 16)
        return _avalanche(total)
    total = _avalanche(total + sum(_mixed(data, 16 * i, 16 * i) for i in range(8)))
    total += sum(_mixed(data, 16 * i, 16 * (i - 8) + 3) for i in range(8, size // 16))
    return _avalanche(total + _mixed(data, size - 16, 136 - 17))


def _sums(stripes, keys):
    """What stripes (..., 8 words) add to the lanes, before anything is scrambled."""
    keyed = stripes ^ keys
    products = (keyed & numpy.uint64(0xFFFFFFFF)) * (keyed >> numpy.uint64(32))
    return products + stripes[..., _SWAPPED]


def _add_blocks(lanes, data):
    """Adds whole blocks; scrambling goes from block to block, all the rest is done at once."""
    blocks = numpy.frombuffer(data, "<u8").reshape(-1, _STRIPES, 8)
    shift, prime = numpy.uint64(47), numpy.uint64(_PRIME32[0])
    for total in _sums(blocks, _KEYS).sum(axis=1, dtype="<u8"):
        lanes += total
        lanes ^= lanes >> shift
        lanes ^= _SCRAMBLE
        lanes *= prime


def _long(file, size):
    lanes = _START.copy()
    left = (size - 1) // _BLOCK * _BLOCK
    while left:
        piece = _read(file, min(left, _PIECE))
        _add_blocks(lanes, piece)
        left -= len(piece)
    rest = _read(file, (size - 1) % _BLOCK + 1)
    whole = (len(rest) - 1) // _STRIPE
    stripes = numpy.frombuffer(rest, "<u8", 8 * whole).reshape(-1, 8)
    lanes += _sums(stripes, _KEYS[:whole]).sum(axis=0, dtype="<u8")
    file.seek(size - _STRIPE)
    lanes += _sums(numpy.frombuffer(_read(file, _STRIPE), "<u8"), _LAST)
    words = [int(lane) for lane in lanes]
    return _avalanche(size * _PRIME64[0] + sum(
        _folded(words[i] ^ _secret_word(11 + 8 * i), words[i + 1] ^ _secret_word(19 + 8 * i)) for i in range(0, 8, 2)))


def _read(file, count):
    data = file.read(count)
    if len(data) != count:
        raise OSError(0, "it ends early")
    return data


def hash_of(path):
    """16 hexadecimal digits, as bake.json has them. Raises OSError."""
    with open(path, "rb") as file:
        size = os.fstat(file.fileno()).st_size
        if size > 240:
            value = _long(file, size)
        else:
            data = _read(file, size)
            value = _to_240(data) if size > 16 else _to_16(data)
    return f"{value:016x}"
