"""One written report with odd verdicts in it, shared by the tests that read it."""

from __future__ import annotations

import pytest
from synthetic_campaign import Written, odd_campaign

from cross_check import report


@pytest.fixture(scope="session")
def odd(tmp_path_factory: pytest.TempPathFactory) -> Written:
    """The report of `odd_campaign`, written once."""
    folder = tmp_path_factory.mktemp("report")
    campaign = odd_campaign()
    path = report.write(folder, campaign)
    return Written(campaign, folder, path.read_text(encoding="utf-8"))
