"""Comparison: pure functions of scenes and records."""
