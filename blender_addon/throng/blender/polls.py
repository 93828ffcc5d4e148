# SPDX-License-Identifier: Apache-2.0
"""Why an operator is not available, for whoever points at its button or calls it from a script."""


def available(cls, missing):
    """What poll() returns. @param missing a sentence that says what to do; empty where nothing is missing"""
    if missing and hasattr(cls, "poll_message_set"):  # panels have none: they just are not there
        cls.poll_message_set(missing)
    return not missing


def in_object_mode(cls, context):
    return available(cls, "" if context.mode == "OBJECT" else "Leave edit mode first (Tab)")
