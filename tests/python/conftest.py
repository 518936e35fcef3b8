"""The order of the tests."""

from __future__ import annotations

import pytest

# Files that take minutes, which come first: a process that begins one at the end would work alone.
LONG = ("test_mutants.py", "test_cli.py")


def pytest_collection_modifyitems(items: list[pytest.Item]) -> None:
    order = {name: place for place, name in enumerate(LONG)}
    items.sort(key=lambda item: order.get(item.path.name, len(order)))
