//! The temperature of the particles over time, and the radii that follow it.
//!
//! | symbol | meaning | unit |
//! |---|---|---|
//! | T | temperature of all particles and of the law | K |
//! | a(T) | radius, by [`Expansion::factor`] from that at the start of the scene | m |

use crate::laws::Surroundings;
use crate::laws::model::ContactModel;
use crate::material::Expansion;

use super::{Setup, Simulation};

/// A temperature that changes linearly over a stage.
#[derive(Clone, Copy, Debug)]
struct Ramp {
    from: f64,
    to: f64,
    first: u64,
    steps: u64,
}

/// What is known of temperature.
#[derive(Clone, Debug)]
pub(super) struct Climate {
    /// What contacts see.
    pub(super) now: Surroundings,
    ramp: Option<Ramp>,
    /// Temperature when the neighbour list was built [K].
    built: f64,
    /// Temperature at which the radii of the scene stand [K].
    start: f64,
    /// Expansion of each material, where one of them has any.
    expansions: Vec<Option<Expansion>>,
    /// Radii at the start, by id [m].
    radius: Vec<f64>,
}

impl Climate {
    pub(super) fn new(setup: &Setup) -> Self {
        let start = setup.temperature.unwrap_or_default();
        let expands = setup.temperature.is_some() && setup.expansions.iter().any(Option::is_some);
        Self {
            now: Surroundings { temperature: start, temperature_before: start, relaxation_time: None },
            ramp: None,
            built: start,
            start,
            expansions: if expands { setup.expansions.clone() } else { Vec::new() },
            radius: if expands { setup.particles.iter().map(|particle| particle.radius).collect() } else { Vec::new() },
        }
    }

    /// Begins a ramp at a step.
    pub(super) fn ramp(&mut self, to: f64, first: u64, steps: u64) {
        self.ramp = Some(Ramp { from: self.now.temperature, to, first, steps });
    }

    /// Ends all ramps: another run goes on from here.
    pub(super) fn hold(&mut self) {
        self.ramp = None;
        self.now.temperature_before = self.now.temperature;
    }

    /// Radius of a particle at a temperature [K] over that at the start.
    fn factor(&self, material: usize, temperature: f64) -> f64 {
        let expansion = self.expansions.get(material).copied().flatten();
        expansion.map_or(1.0, |expansion| expansion.factor(temperature) / expansion.factor(self.start))
    }
}

impl Climate {
    /// What a checkpoint holds of it.
    pub(super) fn saved(&self) -> Vec<f64> {
        let ramp = self.ramp.unwrap_or(Ramp { from: 0.0, to: 0.0, first: 0, steps: 0 });
        let now = &self.now;
        let surroundings = [now.temperature, now.temperature_before, now.relaxation_time.unwrap_or_default()];
        let ramp = [ramp.from, ramp.to, ramp.first as f64, ramp.steps as f64];
        surroundings.into_iter().chain([self.built]).chain(ramp).collect()
    }

    /// Takes what a checkpoint holds; false if that is something else.
    #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "they were saved from such integers")]
    pub(super) fn restore(&mut self, saved: &[f64]) -> bool {
        let &[temperature, temperature_before, relaxation, built, from, to, first, steps] = saved else { return false };
        let relaxation_time = (relaxation > 0.0).then_some(relaxation);
        self.now = Surroundings { temperature, temperature_before, relaxation_time };
        self.built = built;
        self.ramp = (steps > 0.0).then_some(Ramp { from, to, first: first as u64, steps: steps as u64 });
        true
    }
}

impl<M: ContactModel> Simulation<M> {
    /// Brings temperature and radii to the present step.
    pub(super) fn warm(&mut self) {
        let climate = &mut self.climate;
        climate.now.temperature_before = climate.now.temperature;
        let Some(Ramp { from, to, first, steps }) = climate.ramp else { return };
        let done = self.step.saturating_sub(first);
        climate.now.temperature = if done >= steps { to } else { from + (to - from) * (done as f64 / steps as f64) };
        if done >= steps {
            climate.ramp = None;
        }
        self.expand(self.climate.now.temperature);
    }

    /// Gives particles their radii at a temperature [K].
    fn expand(&mut self, temperature: f64) {
        if self.climate.radius.is_empty() {
            return;
        }
        let mut grown = 0.0f64;
        for (place, motion) in self.particles.place.iter_mut().zip(&self.particles.motion) {
            let factor = self.climate.factor(motion.material as usize, temperature);
            let radius = self.climate.radius[motion.id as usize] * factor;
            grown = grown.max(radius - place.radius);
            place.radius = radius;
        }
        self.neighbors.grow(grown);
    }

    /// Gives particles the radii for which the neighbour list was built.
    pub(super) fn as_built(&mut self) {
        self.expand(self.climate.built);
    }

    /// Gives particles their present radii.
    pub(super) fn as_now(&mut self) {
        self.expand(self.climate.now.temperature);
    }

    /// Notes the temperature for which the neighbour list is built.
    pub(super) fn note_built(&mut self) {
        self.climate.built = self.climate.now.temperature;
    }
}
