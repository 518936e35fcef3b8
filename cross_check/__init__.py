"""Crossgrain's harness: states a case once, runs it in several codes, and says where they differ and why."""

from __future__ import annotations

from pathlib import Path

PACKAGE = Path(__file__).parent
