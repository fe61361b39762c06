# SPDX-License-Identifier: GPL-2.0-or-later
"""The one family of exceptions that qmorph raises."""
from __future__ import annotations

from typing import Optional, Tuple


class Error(RuntimeError):
    """What is wrong, where, and what to do.

    kind: the kind of error, in a word ("overlap", "not_manifold", "usage", ...)
    place: x, y and z, or None
    subject: what it is about: ("node", number), ("element", tag), ("surface", tag), ..., or None. With arrays the number is a
        row of `points`; in a Gmsh model it is a tag.
    """

    def __init__(
        self,
        message: str,
        kind: str = "usage",
        place: Optional[Tuple[float, float, float]] = None,
        subject: Optional[Tuple[str, int]] = None,
    ) -> None:
        super().__init__(message)
        self.kind = kind
        self.place = place
        self.subject = subject

    def __reduce__(self):
        return type(self), (str(self), self.kind, self.place, self.subject)


class UsageError(Error, ValueError):
    """An option or an argument makes no sense."""


class InputError(Error):
    """The mesh of a model contradicts itself."""


class SurfaceError(Error):
    """A surface cannot be converted."""


class Cancelled(Error):
    """`progress` returned False. Nothing has changed."""
