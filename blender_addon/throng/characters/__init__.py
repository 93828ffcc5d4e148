# SPDX-License-Identifier: Apache-2.0
"""Your own characters: a rigged model with clips becomes a member of a crowd's cast."""


class CharacterError(Exception):
    """A character cannot be used; the message says why and what to do."""
