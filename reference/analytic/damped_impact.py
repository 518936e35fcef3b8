"""Restitution of a Hertz contact with the dashpot of constant restitution, with and without the cut at zero.

In x = overlap^(5/4) the equation of motion of this contact is that of a linear oscillator with the fraction b of
critical damping (Antypov, Elliott, *EPL* 94 (2011) 50004). If the force may pull, it rebounds after half a period with
e = exp(-pi b / sqrt(1 - b^2)). If it is cut at zero, it leaves when its force vanishes, with
e = exp(-2 b acos(b) / sqrt(1 - b^2)), and exp(-2) for critical damping (Schwager, Poeschel, *Granular Matter* 9 (2007)
465, for the linear spring, carried over by x).
"""

from __future__ import annotations

import math

from cross_check.scene import Scene


def _damping_ratio(scene: Scene) -> float:
    partner = scene.particles[1].material if len(scene.particles) == 2 else scene.bodies[0].material
    pair = scene.pair(scene.particles[0].material, partner)
    if pair is None:
        raise ValueError(f"{scene.name}: the pair of the impact is not stated")
    if pair.restitution is None:
        return pair.damping_ratio
    if pair.restitution == 0.0:
        return 1.0
    logarithm = math.log(pair.restitution)
    return -logarithm / math.hypot(logarithm, math.pi)


def restitution_uncut(scene: Scene) -> float:
    """Rebound over impact speed where the dashpot may pull [-]; 0 for critical damping and beyond."""
    ratio = _damping_ratio(scene)
    return math.exp(-math.pi * ratio / math.sqrt(1.0 - ratio**2)) if ratio < 1.0 else 0.0


def restitution_cut(scene: Scene) -> float:
    """Rebound over impact speed where the force is cut at zero [-], for damping up to critical."""
    ratio = _damping_ratio(scene)
    if ratio > 1.0:
        raise ValueError(f"{scene.name}: damping ratio {ratio} is above critical, the closed form ends at 1")
    return math.exp(-2.0 * ratio * math.acos(ratio) / math.sqrt(1.0 - ratio**2)) if ratio < 1.0 else math.exp(-2.0)


CLOSED_FORMS = {"restitution_uncut": restitution_uncut, "restitution_cut": restitution_cut}
