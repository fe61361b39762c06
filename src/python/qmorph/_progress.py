# SPDX-License-Identifier: GPL-2.0-or-later
"""How far the work has come."""
from __future__ import annotations

from contextlib import contextmanager
from typing import Callable, Iterator, Optional, Union

Callback = Callable[[str, float], Optional[bool]]
Progress = Union[Callback, bool, None]


@contextmanager
def callback_of(progress: Progress) -> Iterator[Optional[Callback]]:
    """What the engine is to call: the user's function, nothing, or one that moves a tqdm bar."""
    if progress is True:
        try:
            from tqdm.auto import tqdm
        except ImportError:
            yield None
            return
        with tqdm(total=100, unit="%") as bar:

            def move(stage: str, share: float) -> None:
                bar.set_description(stage, refresh=False)
                bar.update(round(100 * share) - bar.n)

            yield move
    else:
        yield None if progress is False else progress
