"""The native module has the functions and parameters that its stub tells, and the sintering ones compute the law."""

from __future__ import annotations

import ast
import inspect
import json
from pathlib import Path

import numpy as np
import pytest

import crossgrain

STUB = ast.parse((Path(__file__).parents[2] / "crossgrain.pyi").read_text())
FUNCTIONS = {node.name: node for node in STUB.body if isinstance(node, ast.FunctionDef)}
LAW = json.dumps(
    {
        "law": "luding_sintering",
        "k1": 1e5,
        "k2": 2e5,
        "kc": 1e5,
        "fluid_overlap": 2e-4,
        "dashpot": 0.2,
        "melting_temperature": 393.15,
        "melting_range": 10.0,
        "relaxation_time": 1000.0,
        "cooling": "lagged",
    }
)


def test_the_stub_tells_every_function() -> None:
    native = {name for name in dir(crossgrain) if inspect.isbuiltin(getattr(crossgrain, name))}
    assert native == set(FUNCTIONS)


@pytest.mark.parametrize("name", FUNCTIONS)
def test_the_stub_tells_the_parameters_of_a_function(name: str) -> None:
    arguments = FUNCTIONS[name].args
    names = [argument.arg for argument in arguments.args]
    optional = set(names[len(names) - len(arguments.defaults) :])
    real = inspect.signature(getattr(crossgrain, name)).parameters
    assert names == list(real)
    assert optional == {key for key, parameter in real.items() if parameter.default is not parameter.empty}


def test_a_cold_contact_loads_along_k1_and_unloads_more_steeply() -> None:
    overlaps = np.array([0.5e-4, 1e-4, 0.9e-4])
    found = crossgrain.sintering_contact(LAW, overlaps, np.full(3, 1e5))
    # K(m) between k1 and k2 at l = k2 d_f / (k2 - k1).
    stiffness = 1e5 + 1e5 * 1e-4 / 4e-4
    offset = (1 - 1e5 / stiffness) * 1e-4
    assert found["force"] == pytest.approx([5.0, 10.0, stiffness * (0.9e-4 - offset)])
    assert found["largest_overlap"] == pytest.approx([0.5e-4, 1e-4, 1e-4])
    assert found["stiffness"][1:] == pytest.approx(stiffness)
    assert found["offset"][1:] == pytest.approx(offset)


def test_a_pair_that_is_not_cohesive_does_not_pull() -> None:
    overlaps, stiffness = np.array([2e-4, 0.1e-4]), np.full(2, 1e5)
    assert crossgrain.sintering_contact(LAW, overlaps, stiffness)["force"][1] < 0.0
    assert crossgrain.sintering_contact(LAW, overlaps, stiffness, cohesive=False)["force"][1] >= 0.0


def test_stiffness_follows_temperature_and_time() -> None:
    temperatures, times, steps = np.full(3, 393.15), np.full(3, 0.1), np.full(3, 1e-3)
    # The first temperature is that of the start: half of k1 at the melting temperature, where it stays.
    assert crossgrain.sintering_stiffness(LAW, temperatures, times, steps) == pytest.approx(np.full(3, 5e4))
    hot = crossgrain.sintering_stiffness(LAW, np.array([393.15, 413.15, 413.15]), times, steps)
    target = 0.5e5 * (1 - np.tanh(2.0))
    before, expected = 5e4, [5e4]
    for _ in range(2):
        distance = before - target
        before = target + distance / (1 + distance * 1e-3 / (target * 0.1))
        expected.append(before)
    assert hot == pytest.approx(expected)


def test_sintering_functions_refuse_other_laws_and_lengths() -> None:
    other = json.dumps({"law": "hertz", "force_cut": "on"})
    with pytest.raises(ValueError, match="expected luding_sintering"):
        crossgrain.sintering_contact(other, np.zeros(1), np.ones(1))
    with pytest.raises(ValueError, match="lengths 2 and 1"):
        crossgrain.sintering_contact(LAW, np.zeros(2), np.ones(1))
    with pytest.raises(ValueError, match=r"loading_stiffness = 200000 N/m: above 0, at most k1"):
        crossgrain.sintering_contact(LAW, np.zeros(1), np.array([2e5]))
    with pytest.raises(ValueError, match="different lengths"):
        crossgrain.sintering_stiffness(LAW, np.ones(2), np.ones(1), np.ones(1))
