# SPDX-License-Identifier: Apache-2.0
"""Who somebody is, as numbers that pictures can carry: what renders write, and what is read from it again. Pure Python.

A pixel's value in a pass is the mean over its samples. So that people can be told apart in a pixel that several of them
share, everybody has three numbers of their own, x, y and z, and two passes of three channels hold the means of 1, x,
x^2 and of x^3, y, z: power sums, of which shares and numbers can be solved for.
"""
import hashlib

PASSES = ("ThrongPersonA", "ThrongPersonB")     # of renders
ATTRIBUTES = ("throng_matte_a", "throng_matte_b")  # of the points of a crowd
_BITS = 24  # what a float of single precision holds exactly


def person_name(bake, row):
    """What mattes call a person of a bake."""
    return f"{bake}/{row:05d}"


def person_numbers(name):
    """(x, y, z), each in (0, 1) and exact in single precision."""
    digest = hashlib.sha256(name.encode("utf-8")).digest()
    return tuple((int.from_bytes(digest[at:at + 3], "big") | 1) / 2 ** _BITS for at in (0, 3, 6))


def person_codes(name):
    """What the two passes get where somebody of a name is."""
    x, y, z = person_numbers(name)
    return (1.0, x, x * x), (x * x * x, y, z)
