"""Free fall: the leapfrog reproduces the parabola of a constant acceleration at every step."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from cross_check.scene import Scene


def position_history(scene: Scene, step: NDArray[np.int64]) -> NDArray[np.float64]:
    """Centres at the given steps, shape (T, N, 3) [m]: x + v t + g t^2 / 2 with t = step x time step."""
    time = (step * scene.time_step)[:, None, None]
    start = np.array([particle.position for particle in scene.particles])
    velocity = np.array([particle.velocity for particle in scene.particles])
    return start + velocity * time + 0.5 * np.array(scene.gravity) * time**2


CLOSED_FORMS = {"position_history": position_history}
