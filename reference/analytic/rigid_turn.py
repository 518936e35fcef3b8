"""Rigid rotation of a loaded contact by an angle theta in N steps, the spring in the plane of rotation.

A spring that turns rigidly keeps its length. One that is projected on the new contact plane at every step shrinks by
cos(dtheta), one that is turned by a small angle, h - h x (n0 x n), grows by 1/cos(dtheta) to this order: over N steps
by N dtheta^2/2, dtheta = theta/N [rad]. Stretching a projected spring to its old length keeps it.

Valid for theta^2/N << 1, without sliding, with lever arms that meet in one point; the slip r dtheta^2 theta/6 that the
chord of a step adds, with the distance r [m] of the centres, is left out.
"""

from __future__ import annotations

import math

from cross_check.scene import Scene

# Change of length in units of N dtheta^2/2 [-], by the rotation of the spring.
SHARES = {"rigid": 0.0, "projection_rescaled": 0.0, "projection": -1.0, "small_angles": 1.0}


def tangential_length_change(scene: Scene) -> float:
    """Relative change of the length of the spring over the last stage [-]."""
    leg = scene.drives[0].legs[-1]
    step = math.hypot(*leg.rotation) * scene.time_step
    rotation = "rigid" if scene.mirror.tangential is None else scene.mirror.tangential.rotation
    return SHARES[rotation] * 0.5 * leg.steps * step * step


def tangential_body_change(scene: Scene) -> float:
    """Size of the relative change of the spring in the turning frame [-]: its direction stays."""
    return abs(tangential_length_change(scene))


CLOSED_FORMS = {
    "tangential_length_change": tangential_length_change,
    "tangential_body_change": tangential_body_change,
}
