"""The exception for problems outside of the program, and warnings about them."""
import os
import sys
import warnings

_PACKAGE = os.path.dirname(__file__)


class Error(Exception):
    """The error for a file, a network or an argument that cannot be used: what is wrong, where, and what to do."""

    def __init__(self, what, where="", remedy=""):
        super().__init__((f"{where}: " if where else "") + what + (f" ({remedy})" if remedy else ""))
        self.what, self.where, self.remedy = what, where, remedy


def warn(what, where):
    """Issues a RuntimeWarning at the line outside of this package that is being executed."""
    level, frame = 2, sys._getframe(1)
    while frame.f_back and os.path.dirname(frame.f_code.co_filename) == _PACKAGE:
        level, frame = level + 1, frame.f_back
    warnings.warn(f"barehand: {where}: {what}", RuntimeWarning, stacklevel=level)
