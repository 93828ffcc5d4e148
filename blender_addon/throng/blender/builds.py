# SPDX-License-Identifier: Apache-2.0
"""What the build of Blender that runs this can do."""


def can_denoise():
    """Not every build has Open Image Denoise: Debian's has not."""
    try:
        import _cycles
    except ImportError:
        return False
    return bool(getattr(_cycles, "with_openimagedenoise", False))
