#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Writes a batch's results as Parquet or Arrow.

Usage: export_batch.py BATCH FILE.parquet|FILE.arrow   (needs pyarrow)
"""
import contextlib
import os
import pathlib
import sqlite3
import sys

import pyarrow
import pyarrow.feather
import pyarrow.parquet


def main(batch, target):
    if not target.endswith((".parquet", ".arrow", ".feather")):
        sys.exit(f"{target}: the name has to end in .parquet or .arrow")
    path = pathlib.Path(batch)
    database = path / "results.sqlite" if path.is_dir() else path
    connection = sqlite3.connect(f"file:{database}?mode=ro", uri=True)
    cursor = connection.execute("SELECT * FROM results ORDER BY number")
    names = [column[0] for column in cursor.description]
    columns = list(zip(*cursor.fetchall())) or [()] * len(names)
    table = pyarrow.table({name: list(values) for name, values in zip(names, columns)})
    try:
        write(table, target)
    except OSError as error:
        sys.exit(f"{target}: cannot be written: {error}")


def write(table, target):
    """All of it, or nothing."""
    fresh = pathlib.Path(f"{target}.new-{os.getpid()}")
    try:
        with fresh.open("xb") as file:
            if target.endswith(".parquet"):
                pyarrow.parquet.write_table(table, file)
            else:
                pyarrow.feather.write_feather(table, file)
            file.flush()
            os.fsync(file.fileno())
        fresh.replace(target)
    finally:
        with contextlib.suppress(OSError):
            fresh.unlink()


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    main(*sys.argv[1:])
