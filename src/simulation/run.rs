//! Runs a scene from its first to its last sample, with checkpoints on the way.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::case::scene::{Scene, SceneAction, SceneStage};
use crate::error::Error;
use crate::laws::model::ContactModel;
use crate::laws::registry::Visitor;
use crate::record::Recorder;
use crate::record::checkpoint::{self, Checkpoint};

use super::{Setup, Simulation};

/// Steps between two looks at the clock.
const LOOK: u64 = 64;

/// How a scene is run; results do not depend on it.
#[derive(Clone, Debug)]
pub struct Options {
    /// Number of threads.
    pub threads: usize,
    /// Checkpoints, if any.
    pub checkpoints: Option<Checkpoints>,
}

impl Options {
    /// A run on `threads` threads without checkpoints.
    #[must_use]
    pub fn threads(threads: usize) -> Self {
        Self { threads, checkpoints: None }
    }
}

/// Where and when checkpoints are written.
#[derive(Clone, Debug)]
pub struct Checkpoints {
    /// The file; a run goes on from it if it is there.
    pub file: PathBuf,
    /// Steps between two of them.
    pub steps: Option<u64>,
    /// Time between two of them.
    pub interval: Option<Duration>,
}

/// Runs a scene; `progress` hears the number of finished steps.
///
/// # Errors
/// The scene is not valid, names a law that this build does not have, the run diverges, or a checkpoint cannot be read or written.
pub fn run(scene: &Scene, options: &Options, progress: &(dyn Fn(u64) + Sync)) -> Result<Recorder, Error> {
    scene.check()?;
    let refuse = |reason: String| Error::Scene { scene: scene.name(), reason };
    let specification = scene.model.specification(&scene.mirror).map_err(|problem| refuse(problem.to_string()))?;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(options.threads)
        .build()
        .map_err(|error| refuse(error.to_string()))?;
    pool.install(|| specification.build(Run { scene, options, progress }))
        .map_err(|problem| refuse(problem.to_string()))?
}

/// A run whose model is chosen.
struct Run<'a> {
    scene: &'a Scene,
    options: &'a Options,
    progress: &'a (dyn Fn(u64) + Sync),
}

impl Visitor for Run<'_> {
    type Output = Result<Recorder, Error>;

    fn visit<M: ContactModel>(self, model: M) -> Self::Output {
        samples(self.scene, model, self.options, self.progress)
    }
}

fn samples<M: ContactModel>(
    scene: &Scene,
    model: M,
    options: &Options,
    progress: &(dyn Fn(u64) + Sync),
) -> Result<Recorder, Error> {
    let setup = Setup::new(scene);
    let stages = begins(scene);
    let mut recorder = Recorder::new(scene);
    let hash = checkpoint::scene_hash(scene);
    let mut simulation = match &options.checkpoints {
        Some(plan) if plan.file.is_file() => {
            let saved = Checkpoint::read(&plan.file, &hash)?;
            recorder.restore(&saved);
            let mut simulation = Simulation::restore(&setup, model, &saved)?;
            // What the stages before changed; the one that begins at this step follows below.
            let step = simulation.step();
            stages.iter().filter(|(first, _)| *first < step).for_each(|(_, stage)| simulation.begin_stage(stage));
            simulation
        }
        _ => {
            let mut simulation = Simulation::new(&setup, model)?;
            simulation.sample(&mut recorder)?;
            simulation
        }
    };
    let last = scene.steps / scene.output_every * scene.output_every;
    let mut written = (simulation.step(), Instant::now());
    while simulation.step() < last {
        let step = simulation.step();
        if let Some((_, stage)) = stages.iter().find(|(first, _)| *first == step) {
            simulation.begin_stage(stage);
        }
        let mut next = (step / scene.output_every + 1) * scene.output_every;
        if let Some(plan) = &options.checkpoints {
            next = next.min(plan.steps.map_or(step + LOOK, |steps| (written.0 + steps).max(step + 1)));
        }
        simulation.advance_to(next)?;
        if next.is_multiple_of(scene.output_every) {
            simulation.sample(&mut recorder)?;
            progress(next);
        }
        if let Some(plan) = options.checkpoints.as_ref().filter(|plan| plan.due(next, written)) {
            let mut state = Checkpoint::default();
            simulation.save(&mut state);
            recorder.save(&mut state);
            state.write(&plan.file, &hash)?;
            written = (next, Instant::now());
        }
    }
    Ok(recorder)
}

/// The stages with the steps at which they begin.
fn begins(scene: &Scene) -> Vec<(u64, &SceneStage)> {
    let mut first = 0;
    let stages = scene.stages.iter().map(|stage| {
        let begin = first;
        first += stage.steps;
        (begin, stage)
    });
    stages.collect()
}

impl Checkpoints {
    fn due(&self, step: u64, written: (u64, Instant)) -> bool {
        self.steps.is_some_and(|steps| step >= written.0 + steps)
            || self.interval.is_some_and(|interval| written.1.elapsed() >= interval)
    }
}

impl<M: ContactModel> Simulation<M> {
    /// Records the present state.
    fn sample(&mut self, recorder: &mut Recorder) -> Result<(), Error> {
        self.finite()?;
        let ledger = self.energies();
        recorder.sample(self.step, &self.particles, &self.domain, &self.bodies, &ledger);
        if recorder.keeps_contacts() {
            recorder.contacts(self.contacts.forces(&self.particles));
        }
        Ok(())
    }

    /// Changes what a stage changes at its beginning.
    fn begin_stage(&mut self, stage: &SceneStage) {
        for action in &stage.actions {
            match action {
                SceneAction::SetPair { pair } => {
                    let [a, b] = pair.between;
                    self.table[a * self.materials + b] = Some(*pair);
                    self.table[b * self.materials + a] = Some(*pair);
                }
                SceneAction::SetMotion { body, motion } => self.bodies[*body].set_motion(motion),
                SceneAction::SetGravity { value } => self.gravity = (*value).into(),
            }
        }
    }

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
