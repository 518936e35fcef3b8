//! Who may touch: a list of candidate pairs that stays valid while nothing has moved further than half its skin.
//!
//! The list is rebuilt from all pairs, which suits the few bodies of collisions. Its order (i, then partner) is part
//! of the determinism of a run.

use crate::Vector;
use crate::bodies::Body;
use crate::contacts::Partner;
use crate::geometry;
use crate::particles::Particles;

/// Candidate pairs and the state for which they were found.
#[derive(Clone, Debug)]
pub struct Neighbors {
    skin: f64,
    positions: Vec<Vector>,
    planes: Vec<Vector>,
}

impl Neighbors {
    /// An empty list whose skin is a quarter of the smallest radius [m], plus the `reach` of the law [m].
    #[must_use]
    pub fn new(particles: &Particles, reach: f64) -> Self {
        let smallest = particles.radius.iter().copied().fold(f64::INFINITY, f64::min);
        let skin = if smallest.is_finite() { 0.25 * smallest } else { 0.0 };
        Self { skin: skin + reach, positions: Vec::new(), planes: Vec::new() }
    }

    /// Whether something moved so far that a pair may be missing.
    #[must_use]
    pub fn stale(&self, particles: &Particles, bodies: &[Body], reach: f64) -> bool {
        let allowance = 0.5 * (self.skin - reach);
        let far = |now: &Vector, then: &Vector| (now - then).norm_squared() >= allowance * allowance;
        self.positions.len() != particles.len()
            || particles.position.iter().zip(&self.positions).any(|(now, then)| far(now, then))
            || bodies.iter().zip(&self.planes).any(|(body, then)| far(&body.point, then))
    }

    /// All pairs within the skin, in the order of (i, partner).
    pub fn rebuild(&mut self, particles: &Particles, bodies: &[Body]) -> Vec<(u32, Partner)> {
        self.positions.clone_from(&particles.position);
        self.planes = bodies.iter().map(|body| body.point).collect();
        let mut pairs = Vec::new();
        for (i, index) in (0..particles.len()).zip(0u32..) {
            let (center, radius) = (particles.position[i], particles.radius[i]);
            for (j, other) in (i + 1..particles.len()).zip(index + 1..) {
                let distance = (center - particles.position[j]).norm();
                if distance < radius + particles.radius[j] + self.skin {
                    pairs.push((index, Partner::Particle(other)));
                }
            }
            for (body, other) in bodies.iter().zip(0u32..) {
                if geometry::sphere_plane(center, radius, body.point, body.normal).overlap > -self.skin {
                    pairs.push((index, Partner::Body(other)));
                }
            }
        }
        pairs
    }
}
