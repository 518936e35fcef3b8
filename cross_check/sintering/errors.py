"""What can go wrong in the study."""

from __future__ import annotations


class StudyError(Exception):
    """A study that cannot be planned, run or judged: the message names the run or file and the reason."""
