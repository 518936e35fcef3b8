//! Runs a scene from its first to its last sample.

use crate::case::model::{ForceCut, NormalLaw};
use crate::case::scene::Scene;
use crate::error::Error;
use crate::laws::model::{Composed, ContactModel, Free, Frictionless};
use crate::laws::normal::hertz::Hertz;
use crate::record::Recorder;

use super::{Setup, Simulation};

/// How a scene is run; results do not depend on it.
#[derive(Clone, Copy, Debug)]
pub struct Options {
    /// Number of threads.
    pub threads: usize,
}

/// Runs a scene; `progress` hears the number of finished steps.
///
/// # Errors
/// The scene names a law that this build does not have, or the run diverges.
pub fn run(scene: &Scene, options: Options, progress: &(dyn Fn(u64) + Sync)) -> Result<Recorder, Error> {
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build()
        .map_err(|error| Error::Scene { scene: scene.name(), reason: error.to_string() })?;
    pool.install(|| match &scene.model.normal {
        NormalLaw::Hertz { force_cut } => {
            let normal = Hertz { force_cut: ForceCut::cuts(*force_cut) };
            samples(scene, Composed { normal, tangential: Frictionless, moments: Free }, progress)
        }
        other => Err(Error::Scene { scene: scene.name(), reason: format!("this version has no law {other:?}") }),
    })
}

fn samples<M: ContactModel>(scene: &Scene, model: M, progress: &(dyn Fn(u64) + Sync)) -> Result<Recorder, Error> {
    let mut recorder = Recorder::new(scene);
    let mut simulation = Simulation::new(&Setup::new(scene), model)?;
    loop {
        let step = simulation.step();
        simulation.finite()?;
        let ledger = simulation.energies();
        recorder.sample(step, simulation.particles(), simulation.bodies(), &ledger);
        progress(step);
        let next = step + scene.output_every;
        if next > scene.steps {
            return Ok(recorder);
        }
        simulation.advance_to(next)?;
    }
}

impl<M: ContactModel> Simulation<M> {
    /// Refuses a state that is no longer finite.
    ///
    /// # Errors
    /// The first particle, by id, whose place is not finite.
    pub fn finite(&self) -> Result<(), Error> {
        match self.particles.positions().position(|x| !x.iter().all(|c| c.is_finite())) {
            Some(particle) => Err(Error::Diverged { scene: self.name.clone(), particle, step: self.step }),
            None => Ok(()),
        }
    }
}
