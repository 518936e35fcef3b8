//! A run of several scenes in a folder, and how it goes on after it was stopped.

use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use indicatif::ProgressBar;
use serde::{Deserialize, Serialize};

use super::summary::summary;
use crate::case::scene::Scene;
use crate::error::Error;
use crate::record::checkpoint;
use crate::simulation::{self, Checkpoints, Options};

/// Name of the file that says what a folder runs.
const FILE: &str = "run.json";

/// What a folder runs.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Job {
    /// Name of the case.
    pub name: String,
    /// Number of threads.
    pub threads: usize,
    /// Time between two checkpoints [s].
    pub checkpoint_seconds: f64,
    /// Steps between two checkpoints.
    pub checkpoint_steps: Option<u64>,
    /// The scenes.
    pub scenes: Vec<Scene>,
}

impl Job {
    /// Prepares a folder: what an earlier run left to be resumed is removed.
    pub fn begin(&self, folder: &Path) -> Result<(), Error> {
        let failed = |reason| Error::Write { file: folder.to_owned(), reason };
        for scene in &self.scenes {
            let place = self.place(folder, scene);
            fs::create_dir_all(&place).map_err(failed)?;
            for name in ["checkpoint.npz", "summary.json"] {
                let file = place.join(name);
                if file.exists() {
                    fs::remove_file(file).map_err(failed)?;
                }
            }
        }
        let text = serde_json::to_vec(self).map_err(|error| failed(error.into()))?;
        checkpoint::replace(&folder.join(FILE), &text).map_err(failed)
    }

    /// Reads what a folder runs.
    pub fn read(folder: &Path) -> Result<Self, Error> {
        let file = folder.join(FILE);
        let text = fs::read_to_string(&file).map_err(|reason| Error::Read { file: file.clone(), reason })?;
        serde_json::from_str(&text)
            .map_err(|error| Error::Parse { file: file.display().to_string(), message: error.to_string() })
    }

    /// Runs the scenes that have no summary yet, each from its checkpoint if it has one.
    pub fn run(&self, folder: &Path) -> Result<(), Error> {
        let progress = super::bar(self.scenes.iter().map(|scene| scene.steps).sum());
        let mut done = 0;
        for scene in &self.scenes {
            let place = self.place(folder, scene);
            if !place.join("summary.json").is_file() {
                self.run_scene(scene, folder.join("states"), &place, &progress, done)?;
            }
            done += scene.steps;
            progress.set_position(done);
        }
        progress.finish_and_clear();
        Ok(())
    }

    fn place(&self, folder: &Path, scene: &Scene) -> PathBuf {
        if self.scenes.len() == 1 { folder.to_owned() } else { folder.join(scene.member()) }
    }

    fn run_scene(
        &self,
        scene: &Scene,
        states: PathBuf,
        folder: &Path,
        progress: &ProgressBar,
        done: u64,
    ) -> Result<(), Error> {
        let failed = |reason| Error::Write { file: folder.to_owned(), reason };
        fs::create_dir_all(folder).map_err(failed)?;
        let file = folder.join("checkpoint.npz");
        let interval = Duration::try_from_secs_f64(self.checkpoint_seconds).ok();
        let checkpoints = Some(Checkpoints { file: file.clone(), steps: self.checkpoint_steps, interval });
        let options = Options { threads: self.threads, checkpoints, states: Some(states), save_at: Vec::new() };
        let recorder = simulation::run(scene, &options, &|step| {
            if (step / scene.output_every).is_multiple_of(1024) {
                progress.set_position(done + step);
            }
        })?;
        let text = serde_json::to_string_pretty(&summary(scene, &recorder)?).unwrap_or_default();
        recorder.write(&folder.join("record"))?;
        checkpoint::replace(&folder.join("summary.json"), (text + "\n").as_bytes()).map_err(failed)?;
        if file.exists() {
            fs::remove_file(file).map_err(failed)?;
        }
        Ok(())
    }
}
