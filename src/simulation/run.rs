//! Runs a scene from its first to its last sample, with checkpoints on the way.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use crate::bodies::{BodyShape, Course};
use crate::case::scene::{Scene, SceneAction, SceneStage};
use crate::error::Error;
use crate::laws::memory::Memory;
use crate::laws::model::ContactModel;
use crate::laws::registry::Visitor;
use crate::record::Recorder;
use crate::record::checkpoint::{self, Checkpoint};

use super::states::{self, States};
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
    /// Folder of states from which other scenes start: they are taken from there, and saved there.
    pub states: Option<PathBuf>,
    /// Steps whose states are saved there.
    pub save_at: Vec<u64>,
}

impl Options {
    /// A run on `threads` threads without checkpoints.
    #[must_use]
    pub fn threads(threads: usize) -> Self {
        Self { threads, checkpoints: None, states: None, save_at: Vec::new() }
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
    let stages = begins(scene);
    let mut recorder = Recorder::new(scene, M::SHARED, M::History::WIDTH);
    let hash = checkpoint::scene_hash(scene);
    let states = States::new(scene, options);
    let mut simulation = match &options.checkpoints {
        Some(plan) if plan.file.is_file() => {
            let saved = Checkpoint::read(&plan.file, &hash)?;
            recorder.restore(&saved);
            go_on(scene, model, &saved)?
        }
        _ => {
            let mut simulation = start(scene, model, options)?;
            simulation.sample(&mut recorder)?;
            simulation
        }
    };
    let last = scene.last_sample();
    let mut written = (simulation.step(), Instant::now());
    while simulation.step() < last {
        let step = simulation.step();
        if let Some((first, stage)) = stages.iter().find(|(first, _)| *first == step) {
            simulation.begin_stage(stage, *first);
        }
        let sampled = scene.next_sample(step);
        let mut next = states.next(step).map_or(sampled, |save| save.min(sampled));
        if let Some(plan) = &options.checkpoints {
            next = next.min(plan.steps.map_or(step + LOOK, |steps| (written.0 + steps).max(step + 1)));
        }
        simulation.advance_to(next)?;
        if next == sampled {
            simulation.sample(&mut recorder)?;
            progress(next);
        }
        states.save(&simulation)?;
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

/// Goes on to a step without samples.
pub(super) fn walk<M: ContactModel>(scene: &Scene, simulation: &mut Simulation<M>, to: u64) -> Result<(), Error> {
    let stages = begins(scene);
    while simulation.step() < to {
        let step = simulation.step();
        if let Some((first, stage)) = stages.iter().find(|(first, _)| *first == step) {
            simulation.begin_stage(stage, *first);
        }
        let next = stages.iter().map(|(first, _)| *first).find(|first| *first > step);
        simulation.advance_to(next.map_or(to, |next| next.min(to)))?;
    }
    simulation.finite()
}

/// The first step of a scene: its own, or that which another scene has come to.
pub(super) fn start<M: ContactModel>(scene: &Scene, model: M, options: &Options) -> Result<Simulation<M>, Error> {
    let setup = Setup::new(scene);
    let Some(start) = &scene.start else { return Simulation::new(&setup, model) };
    let state = states::reach(&start.scene, start.step, options)?;
    let names: Vec<String> = start.scene.bodies.iter().map(|body| body.name.clone()).collect();
    Simulation::branch(&setup, model, &state, &names)
}

/// A scene from a checkpoint on: what the stages before changed is changed again; the stage that begins at its step follows.
pub(super) fn go_on<M: ContactModel>(scene: &Scene, model: M, saved: &Checkpoint) -> Result<Simulation<M>, Error> {
    let step = saved.get_counts("step").first().copied().unwrap_or_default();
    let mut before = begins(scene);
    before.retain(|(first, _)| *first < step);
    Simulation::restore(&Setup::new(scene), model, saved, &before)
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
        let shared = crate::record::numbers(&self.shared);
        let climate = (self.climate.now.temperature, &shared[..]);
        recorder.sample(self.step, &self.particles, &self.domain, &self.bodies, &ledger, climate);
        if recorder.keeps_contacts() {
            recorder.contacts(&self.contacts.living_contacts(&self.particles));
        }
        Ok(())
    }

    /// Changes what a stage changes at its beginning, the step `first`.
    pub(super) fn begin_stage(&mut self, stage: &SceneStage, first: u64) {
        for action in &stage.actions {
            match action {
                SceneAction::SetPair { pair } => {
                    let [a, b] = pair.between;
                    self.table[a * self.materials + b] = Some(*pair);
                    self.table[b * self.materials + a] = Some(*pair);
                }
                SceneAction::SetMotion { body, motion } => self.bodies[*body].set_motion(motion, first),
                SceneAction::SetGravity { value } => self.gravity = (*value).into(),
                SceneAction::Remove { body } => {
                    self.bodies[*body].remove();
                    self.stale = true;
                }
                SceneAction::Strain { body, from, strain } => {
                    let away = self.bodies[*from].point - self.bodies[*body].point;
                    let BodyShape::Plane { normal } = self.bodies[*body].shape else { continue };
                    let amplitude = normal * (away.dot(&normal) * strain);
                    self.bodies[*body].set_path(amplitude, Course::Strain { steps: stage.steps }, first);
                }
                SceneAction::RampTemperature { to } => self.climate.ramp(*to, first, stage.steps),
                SceneAction::SetRelaxationTime { value } => self.climate.now.relaxation_time = Some(*value),
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
