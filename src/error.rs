//! The one error type: what is wrong, where, the value and what is allowed.

use std::path::PathBuf;

use thiserror::Error;

/// Everything that can go wrong between a case file and a record.
#[derive(Debug, Error)]
pub enum Error {
    /// A file could not be read.
    #[error("{}: {reason}", file.display())]
    Read {
        /// The file.
        file: PathBuf,
        /// What the system said.
        reason: std::io::Error,
    },
    /// A file could not be written.
    #[error("{}: cannot write ({reason})", file.display())]
    Write {
        /// The file or folder.
        file: PathBuf,
        /// What the system said.
        reason: std::io::Error,
    },
    /// A case file without content.
    #[error("{file}: the file is empty, expected a case (see `crossgrain schema`)")]
    Empty {
        /// The file.
        file: String,
    },
    /// Text that is not a case: syntax, an unknown key, a wrong type or unit.
    #[error("{file}: {message}")]
    Parse {
        /// The file, with the variant where one was being built.
        file: String,
        /// Line, caret and reason.
        message: String,
    },
    /// A value that the schema can hold and the physics cannot.
    #[error("{file}:{line}: {problem}")]
    Invalid {
        /// The file, with the variant where one was being built.
        file: String,
        /// Line of the key, 0 if the key stands nowhere.
        line: usize,
        /// Key, value and what is allowed.
        problem: Problem,
    },
    /// A scene that the engine cannot run.
    #[error("scene {scene}: {reason}")]
    Scene {
        /// Name of the scene.
        scene: String,
        /// What is wrong.
        reason: String,
    },
    /// A run whose state stopped being finite.
    #[error("scene {scene}: particle {particle} is no longer at a finite place at step {step}; a smaller time step may help")]
    Diverged {
        /// Name of the scene.
        scene: String,
        /// Index of the particle.
        particle: usize,
        /// Step at which this was seen.
        step: u64,
    },
    /// No scene of the case has the wanted name.
    #[error("no variant `{wanted}` (known: {known})")]
    UnknownVariant {
        /// What was asked for.
        wanted: String,
        /// What there is.
        known: String,
    },
}

/// A key whose value is not allowed.
#[derive(Clone, Debug, PartialEq, Error)]
#[error("{key} = {value}: {allowed}")]
pub struct Problem {
    /// Path of the key: `particles.0.radius`.
    pub key: String,
    /// The value as read.
    pub value: String,
    /// What is allowed.
    pub allowed: String,
}

impl Problem {
    /// A problem at `key`.
    pub fn new(key: impl Into<String>, value: impl ToString, allowed: impl Into<String>) -> Self {
        Self { key: key.into(), value: value.to_string(), allowed: allowed.into() }
    }
}
