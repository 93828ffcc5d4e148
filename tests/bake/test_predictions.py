# SPDX-License-Identifier: Apache-2.0
"""What docs/benchmarks/predicted.md says of GPUs that are not at hand: it agrees with the one that was."""
import importlib.util

import pytest

from conftest import ROOT

spec = importlib.util.spec_from_file_location("predict_steps", ROOT / "scripts" / "predict_steps.py")
predict = importlib.util.module_from_spec(spec)
spec.loader.exec_module(predict)


@pytest.fixture(scope="module")
def known(throng):
    text = predict.MEASURED.read_text()
    return text, predict.fitted(text), predict.counted(throng.binary)


def step(launches, costs, people, bandwidth):
    return sum(time for _, _, time in predict.predicted(launches, costs, people, bandwidth)) / 1000.0


def test_sizes_that_were_not_fitted_are_met_within_a_quarter(known):
    text, costs, launches = known
    then = predict.as_measured(launches, text)
    whole = predict.whole_steps(text)
    assert sorted(whole) == [256, 4096, 16384, 65536, 262144, 1048576]
    for people, measured in whole.items():
        off = step(then, costs, people, predict.BANDWIDTH) / measured - 1
        assert abs(off) < (0.01 if people in predict.PEOPLE else 0.25), (people, off)


def test_the_program_has_the_launches_that_were_measured_and_few_more(known):
    _, costs, launches = known
    now = {what for _, what, _, _ in launches}
    assert set(costs) <= now and len(now - set(costs)) <= 2, now ^ set(costs)


def test_what_a_launch_takes_for_nobody_is_all_that_is_left_on_an_endless_bandwidth(known):
    _, costs, launches = known
    alone = step(launches, costs, 262144, 1e12)
    assert alone == pytest.approx(step(launches, costs, 0, 300.0), rel=1e-3)
    halved = step(launches, costs, 262144, 500.0) - alone
    assert halved == pytest.approx(2 * (step(launches, costs, 262144, 1000.0) - alone))
    for people in predict.PEOPLE:  # and nothing is faster than its bytes
        for bandwidth in predict.GPUS.values():
            bytes_alone = predict.least(launches, people, bandwidth) / 1000.0
            assert bytes_alone < step(launches, costs, people, bandwidth)


def test_a_program_that_is_new_costs_what_the_middle_one_does(known):
    _, costs, launches = known
    sizes = {what: size for _, what, _, size in launches}
    new = predict.cost_of("shaders/new.comp", 100, costs, sizes)
    twice = predict.cost_of("shaders/new.comp", 200, costs, sizes)
    assert new.alone == twice.alone > 0 and twice.a_person == pytest.approx(2 * new.a_person) and new.a_person > 0
