# SPDX-License-Identifier: Apache-2.0
"""What scripts that run in a Blender ask of operators."""


def refused(call, **arguments):
    """Why an operator does not do it."""
    try:
        call(**arguments)
        return "no error"
    except RuntimeError as error:
        return str(error)


def refusal(call):
    """The words of its complaint alone; none where it does it."""
    try:
        call()
        return ""
    except RuntimeError as error:
        return str(error).replace("Error: ", "").strip()
