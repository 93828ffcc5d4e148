# SPDX-License-Identifier: Apache-2.0
"""The words of a bake's account, as base/outcomes.h has them. Pure Python."""
SPAWNED, WALKING, WAITING, ARRIVED, SEATED, STUCK, REFUSED = ("spawned", "walking", "waiting", "arrived", "seated",
                                                             "stuck", "refused")


def account_text(account):
    """An account in a line: "12 people: 8 arrived, 3 walking, 1 refused"."""
    counts = ", ".join(f"{account[word]} {word}" for word in (ARRIVED, WALKING, REFUSED) if word in account)
    return f"{account['agents']} people: {counts}"
