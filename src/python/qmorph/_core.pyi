# SPDX-License-Identifier: GPL-2.0-or-later
from typing import Any, Callable, Dict, List, Optional

import numpy as np

def convert(
    points: Any, triangles: Any, quads: Any, constraints: Any, fixed: Any, options: Dict[str, Any],
    progress: Optional[Callable[[str, float], Optional[bool]]],
) -> Dict[str, Any]: ...
def improve(
    points: Any, triangles: Any, quads: Any, constraints: Any, fixed: Any, options: Dict[str, Any],
    progress: Optional[Callable[[str, float], Optional[bool]]],
) -> Dict[str, Any]: ...
def measure(points: Any, triangles: Any, quads: Any) -> Dict[str, Any]: ...
version: str

def locate(places: Any, points: Any, triangles: Any) -> np.ndarray: ...
def option_names() -> List[str]: ...
