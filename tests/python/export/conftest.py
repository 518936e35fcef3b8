"""One bed, run once and shared by the tests that export it."""

from __future__ import annotations

import pytest
import small_bed
from small_bed import Bed


@pytest.fixture(scope="session")
def bed(tmp_path_factory: pytest.TempPathFactory) -> Bed:
    """A small bed with contacts, in a periodic box."""
    return small_bed.make(tmp_path_factory.mktemp("bed"))
