# SPDX-License-Identifier: Apache-2.0
"""The table of people with bodies, and with discs, beside what was measured with people: scripts/body_flows.py."""

import sys

from runs import ROOT

sys.path.insert(0, str(ROOT / "scripts"))
import body_flows  # noqa: E402

NAMES = {"body": "Bodies", "disc": "Discs"}


def bodies(runs):
    names, seeds = (["kretz-080"] if runs.quick else []), runs.seeds(8)
    tables = []
    for kind, people in body_flows.PEOPLE.items():

        def measured(people=people):
            return list(body_flows.rows_of(body_flows.cases(people), runs.program, seeds, [], names))

        script = ROOT / "scripts" / "body_flows.py"
        rows = runs.known(f"people as they come: {kind}", measured, script, kind, seeds, names)
        head = body_flows.HEAD.replace("| |", f"| {NAMES[kind]} |", 1)
        tables.append("\n".join([head, body_flows.RULE, *rows]))
    return "\n\n".join(tables)
