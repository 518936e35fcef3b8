//! The one error type: what is wrong, where, the value and what is allowed.

use std::fmt;
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
    /// Bytes that are not text.
    #[error("{place}: byte 0x{byte:02x} is not UTF-8 text, expected a case in TOML")]
    NotText {
        /// Where.
        place: Place,
        /// The byte.
        byte: u8,
    },
    /// Text that is not a scene.
    #[error("{file}: {message}")]
    Parse {
        /// The file.
        file: String,
        /// Line, column and reason.
        message: String,
    },
    /// Text that is not a case: syntax, an unknown key, a wrong type or unit.
    #[error("{place}: {}{message}", if key.is_empty() { String::new() } else { format!("{key}: ") })]
    Malformed {
        /// Where.
        place: Place,
        /// Path of the key, empty if there is none.
        key: String,
        /// What is there and what was expected.
        message: String,
    },
    /// A value that the schema can hold and the physics cannot.
    #[error("{place}: {problem}")]
    Invalid {
        /// Where.
        place: Place,
        /// Key, value and what is allowed.
        problem: Box<Problem>,
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
    #[error(
        "scene {scene}: particle {particle} is no longer at a finite place at step {step}; a smaller time step may help"
    )]
    Diverged {
        /// Name of the scene.
        scene: String,
        /// Index of the particle.
        particle: usize,
        /// Step at which this was seen.
        step: u64,
    },
    /// An observable that cannot be measured.
    #[error("observable {observable}: {reason}")]
    Measure {
        /// Name of the observable.
        observable: String,
        /// What is wrong.
        reason: String,
    },
    /// Columns of a record that do not fit together.
    #[error("record: {reason}")]
    Columns {
        /// What is wrong.
        reason: String,
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

/// A place in the statement of a case.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Place {
    /// The file.
    pub file: String,
    /// Line of the file, 0 if no line says it.
    pub line: usize,
    /// The variant or the override that says it, empty if the file itself does.
    pub origin: String,
}

impl fmt::Display for Place {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}", self.file)?;
        if self.line > 0 {
            write!(f, ":{}", self.line)?;
        }
        if !self.origin.is_empty() {
            write!(f, " ({})", self.origin)?;
        }
        Ok(())
    }
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
    #[expect(clippy::needless_pass_by_value, reason = "values are numbers or borrowed")]
    pub fn new(key: impl Into<String>, value: impl ToString, allowed: impl Into<String>) -> Self {
        Self { key: key.into(), value: value.to_string(), allowed: allowed.into() }
    }
}
