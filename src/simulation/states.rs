//! States from which other scenes start: files named by the hash of their scene and of this engine, and the step.

use std::path::{Path, PathBuf};

use crate::case::scene::Scene;
use crate::error::Error;
use crate::laws::model::ContactModel;
use crate::laws::registry::Visitor;
use crate::record::checkpoint::{self, Checkpoint};

use super::Simulation;
use super::run::{self, Options};

/// States that a run saves.
pub(super) struct States<'a> {
    folder: Option<&'a Path>,
    hash: String,
    steps: &'a [u64],
}

impl<'a> States<'a> {
    pub(super) fn new(scene: &Scene, options: &'a Options) -> Self {
        Self { folder: options.states.as_deref(), hash: hash(scene), steps: &options.save_at }
    }

    /// The next step after `step` whose state is saved.
    pub(super) fn next(&self, step: u64) -> Option<u64> {
        self.folder.and_then(|_| self.steps.iter().copied().filter(|save| *save > step).min())
    }

    /// Saves the present state if it is one of those.
    pub(super) fn save<M: ContactModel>(&self, simulation: &Simulation<M>) -> Result<(), Error> {
        let step = simulation.step();
        match self.folder {
            Some(folder) if self.steps.contains(&step) => {
                let mut state = Checkpoint::default();
                simulation.save(&mut state);
                std::fs::create_dir_all(folder).map_err(|reason| Error::Write { file: folder.to_owned(), reason })?;
                state.write(&file(folder, &self.hash, step), &self.hash)
            }
            _ => Ok(()),
        }
    }
}

/// Ties a state to its scene and to the sources of this engine: another one may compute other bits.
fn hash(scene: &Scene) -> String {
    let parts = [checkpoint::scene_hash(scene), env!("CROSSGRAIN_ENGINE").to_owned()];
    blake3::hash(parts.join("-").as_bytes()).to_string()
}

fn file(folder: &Path, hash: &str, step: u64) -> PathBuf {
    folder.join(format!("{hash}-{step}.npz"))
}

/// The latest saved state of a scene up to a step.
fn latest(folder: &Path, hash: &str, step: u64) -> Option<(u64, PathBuf)> {
    let found = std::fs::read_dir(folder).ok()?.filter_map(|entry| {
        let path = entry.ok()?.path();
        let name = path.file_stem()?.to_str()?;
        let saved: u64 = name.strip_prefix(hash)?.strip_prefix('-')?.parse().ok()?;
        (path.extension()? == "npz" && saved <= step).then_some((saved, path))
    });
    found.max()
}

/// The state of a scene after `step` steps: from the folder of states, going on from an earlier one there, or from the
/// scene's start. It is saved there.
pub(super) fn reach(scene: &Scene, step: u64, options: &Options) -> Result<Checkpoint, Error> {
    scene.check()?;
    let refuse = |reason: String| Error::Scene { scene: scene.name(), reason };
    let specification = scene.model.specification(&scene.mirror).map_err(|problem| refuse(problem.to_string()))?;
    specification.build(Reach { scene, step, options }).map_err(|problem| refuse(problem.to_string()))?
}

/// A way to a step, whose model is chosen.
struct Reach<'a> {
    scene: &'a Scene,
    step: u64,
    options: &'a Options,
}

impl Visitor for Reach<'_> {
    type Output = Result<Checkpoint, Error>;

    fn visit<M: ContactModel>(self, model: M) -> Self::Output {
        let Self { scene, step, options } = self;
        let hash = hash(scene);
        let saved = options.states.as_ref().and_then(|folder| latest(folder, &hash, step));
        let mut simulation = match saved {
            Some((found, path)) => {
                let state = Checkpoint::read(&path, &hash)?;
                if found == step {
                    return Ok(state);
                }
                run::go_on(scene, model, &state)?
            }
            None => run::start(scene, model, options)?,
        };
        run::walk(scene, &mut simulation, step)?;
        let save_at = [step];
        States { folder: options.states.as_deref(), hash, steps: &save_at }.save(&simulation)?;
        let mut state = Checkpoint::default();
        simulation.save(&mut state);
        Ok(state)
    }
}
