# SPDX-License-Identifier: Apache-2.0
"""Batches on a real Slurm: controller, node and authentication on this machine."""
import json
import os
import pathlib
import shutil
import signal
import socket
import sqlite3
import subprocess
import time

import pytest

from processor_time import HANGS

HERE = pathlib.Path(__file__).resolve().parent

BASE = {
    "throng": 1,
    "simulation": {"duration": 4},
    "areas": [{"id": "west", "polygon": [[0, 0], [2, 0], [2, 4], [0, 4]]},
              {"id": "east", "polygon": [[10, 0], [12, 0], [12, 4], [10, 4]]}],
    "walls": [{"points": [[-1, -0.5], [13, -0.5]]}],
    "flows": [{"id": "walkers", "from": "west", "to": "east", "rate": 5}],
}


def wait_for(ready, seconds, what):
    end = time.monotonic() + seconds
    while not ready():
        assert time.monotonic() < end, f"{what} did not come up within {seconds} s"
        time.sleep(0.1)


def run(*words, **options):
    return subprocess.run(words, capture_output=True, text=True, **options)


@pytest.fixture(scope="module")
def slurm(tmp_path_factory):
    if not shutil.which("slurmctld") or not shutil.which("munged"):
        pytest.skip("Slurm is not installed (slurm-wlm, munge)")
    if os.geteuid() != 0:
        pytest.skip("a Slurm of one's own needs root")
    if not os.path.ismount("/sys/fs/cgroup"):
        pytest.skip("slurmd does not start where no cgroups are mounted at /sys/fs/cgroup (some containers)")
    folder = tmp_path_factory.mktemp("slurm")
    for name in ("state", "spool", "munge"):
        (folder / name).mkdir(mode=0o755)
    for parent in [folder, *folder.parents]:
        if parent.is_relative_to(tmp_path_factory.getbasetemp()):
            parent.chmod(0o755)
    host = socket.gethostname().split(".")[0]
    text = (HERE / "slurm.conf.in").read_text()
    for word, value in {"@D@": folder, "@HOST@": host, "@CPUS@": os.cpu_count()}.items():
        text = text.replace(word, str(value))
    (folder / "slurm.conf").write_text(text)
    key = folder / "munge" / "key"
    key.write_bytes(os.urandom(1024))
    key.chmod(0o400)
    environment = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}
    munge = folder / "munge"
    servers = []

    def start(*words):
        servers.append(subprocess.Popen(words, env=environment, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL))

    try:
        start("munged", "--force", "--foreground", f"--key-file={key}", f"--socket={munge}/socket",
              f"--pid-file={munge}/pid", f"--log-file={munge}/log",
              f"--seed-file={munge}/seed", "--num-threads=2")
        wait_for(lambda: run("munge", "-S", f"{munge}/socket", "-n").returncode == 0, 20, "munged")
        start("slurmctld", "-D", "-c")
        start("slurmd", "-D", "-N", host)
        wait_for(lambda: run("sinfo", "-h", "-o", "%T", env=environment).stdout.strip() == "idle", 60, "Slurm")
        yield {"environment": environment, "host": host, "folder": folder}
    finally:
        for server in reversed(servers):
            server.terminate()
        for server in servers:
            try:
                server.wait(timeout=15)
            except subprocess.TimeoutExpired:
                server.kill()


def family(folder, scenarios, **changes):
    path = folder / "family.json"
    path.write_text(json.dumps({"throng_family": 1, "name": "on slurm", "base": BASE,
                                "axes": [{"name": "seed", "set": "/simulation/seed", "range": [1, scenarios]}],
                                **changes}))
    return path


def statuses(folder):
    connection = sqlite3.connect(f"file:{folder / 'results.sqlite'}?mode=ro", uri=True)
    return [row[0] for row in connection.execute("SELECT status FROM scenarios")]


def tasks_at_work(output):
    """Processes of array tasks: those that were started with --shard for this batch."""
    found = []
    for path in pathlib.Path("/proc").glob("[0-9]*/cmdline"):
        try:
            words = path.read_bytes().split(b"\0")
        except OSError:
            continue
        if b"--shard" in words and str(output).encode() in words:
            found.append(int(path.parent.name))
    return found


def test_killed_jobs_and_a_drained_node_leave_a_complete_batch(throng, slurm, tmp_path):
    output = tmp_path / "out"
    plan = family(tmp_path, 200, base={**BASE, "simulation": {"duration": 20}})
    process = subprocess.Popen([throng.binary, "batch", str(plan), "-o", str(output), "--executor", "slurm", "--tasks",
                                "20"],
                               env=slurm["environment"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True)
    done = lambda: len(list((output / "results").glob("*.json")))
    # Each is killed as it begins: one that is all but done would leave nothing to do again.
    for target in (20, 60):
        wait_for(lambda: done() >= target or process.poll() is not None, 120, "results")
        older = set(tasks_at_work(output))
        wait_for(lambda: set(tasks_at_work(output)) - older or process.poll() is not None, 60, "a task that begins")
        for task in set(tasks_at_work(output)) - older:
            os.kill(task, signal.SIGKILL)
    assert process.poll() is None
    node = f"nodename={slurm['host']}"
    assert run("scontrol", "update", node, "state=drain", "reason=test", env=slurm["environment"]).returncode == 0
    wait_for(lambda: "drained" in run("sinfo", "-h", "-o", "%T", env=slurm["environment"]).stdout, 60,
             "the drained node")
    held = done()
    time.sleep(3)
    assert done() == held < 200 and process.poll() is None, "nothing runs on a drained node, and the batch waits"
    assert run("scontrol", "update", node, "state=resume", env=slurm["environment"]).returncode == 0
    told, errors = process.communicate(timeout=HANGS)
    assert process.returncode == 0, told + errors
    assert errors.count("submitted") >= 2, "what the killed jobs left was submitted again"
    assert statuses(output) == ["ok"] * 200
    assert len(list((output / "bakes").iterdir())) == 200


def test_a_submitted_batch_is_joined_later(throng, slurm, tmp_path):
    output = tmp_path / "out"
    words = ["batch", family(tmp_path, 12), "-o", output, "--executor", "slurm", "--tasks", "2"]
    throng(*words, "--no-wait", env=slurm["environment"], expect=85)
    joined = throng(*words, env=slurm["environment"])
    assert "is under way" in joined.stderr or "12 are done" in joined.stdout
    assert statuses(output) == ["ok"] * 12


def test_ctrl_c_takes_the_job_out_of_the_queue(throng, slurm, tmp_path):
    output = tmp_path / "out"
    plan = family(tmp_path, 60, base={**BASE, "simulation": {"duration": 60}})
    process = subprocess.Popen([throng.binary, "batch", str(plan), "-o", str(output), "--executor", "slurm", "--tasks",
                                "3", "-q"], env=slurm["environment"])
    wait_for(lambda: len(list((output / "results").glob("*.json"))) > 0, 60, "the first result")
    process.send_signal(signal.SIGINT)
    assert process.wait(timeout=HANGS) == 130
    wait_for(lambda: run("squeue", "-h", env=slurm["environment"]).stdout.strip() == "", 30, "the empty queue")
    wait_for(lambda: not tasks_at_work(output), 15, "the end of the tasks")
    assert {path.name for path in (output / "bakes").iterdir()} == \
        {path.stem for path in (output / "results").glob("*.json")}


def test_tasks_that_run_out_of_time_are_gone_on_with(throng, slurm, tmp_path):
    # Each scenario takes longer than the limit that its task works under: checkpoints carry it over.
    output = tmp_path / "out"
    crowd = {**BASE, "simulation": {"duration": 3600},
             "flows": [{"id": "walkers", "from": "west", "to": "east", "rate": 2}]}
    plan = family(tmp_path, 1, base=crowd, bake={"streams": "packed"})  # or it would be gigabytes
    process = subprocess.Popen([throng.binary, "batch", str(plan), "-o", str(output),
                                "--executor", "slurm", "--tasks", "1",
                                "--checkpoint", "0.01", "--time-limit", "0.6", "--retries", "30"],
                               env=slurm["environment"], stderr=subprocess.PIPE, text=True)
    wait_for(lambda: list(output.glob("bakes/*.unfinished/checkpoint.a")), 60, "a checkpoint")
    wait_for(lambda: "submitted" in (process.stderr.readline() + process.stderr.readline()), 120, "the second array")
    process.send_signal(signal.SIGINT)
    process.communicate(timeout=HANGS)
    assert list(output.glob("bakes/*.unfinished/checkpoint.a")), "what was done so far is kept"


def test_what_sbatch_complains_of_is_told(throng, slurm, tmp_path):
    process = throng("batch", family(tmp_path, 2), "-o", tmp_path / "out", "--executor", "slurm", "--sbatch",
                     "--partition=nowhere",
                     env=slurm["environment"], expect=3)
    assert "nowhere" in process.stderr or "partition" in process.stderr


def test_without_slurm_the_error_says_so(throng, tmp_path):
    process = throng("batch", family(tmp_path, 2), "-o", tmp_path / "out", "--executor", "slurm",
                     env={**os.environ, "PATH": "/nowhere"}, expect=3)
    assert "needs Slurm's commands" in process.stderr
