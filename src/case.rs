//! The case file: schema, sweeps, checks, and the scenes that come of it.

mod check;
pub mod model;
pub mod protocol;
pub mod quantity;
pub mod scene;
pub mod schema;
mod sweep;

use std::path::Path;

use serde::Serialize;

use crate::error::Error;
use scene::Scene;
use schema::Case;

/// A case with everything that follows from it.
#[derive(Clone, Debug, Serialize)]
pub struct Loaded {
    /// The case as stated.
    pub case: Case,
    /// Its variants, in the order of the sweep.
    pub variants: Vec<sweep::Variant>,
    /// Runnable scenes: variants, each with its refinements.
    pub scenes: Vec<Scene>,
}

/// The JSON schema of the case file.
#[must_use]
pub fn json_schema() -> serde_json::Value {
    schemars::schema_for!(Case).to_value()
}

/// Reads and checks a case file. `overrides` are `key=value` pairs such as `time.step.value="1e-8 s"`.
///
/// # Errors
/// The file cannot be read, is not a case, or states what the physics does not allow.
pub fn read(path: &Path, overrides: &[String]) -> Result<Stated, Error> {
    let text =
        std::fs::read_to_string(path).map_err(|reason| Error::Read { file: path.to_owned(), reason })?;
    Stated::parse(&path.display().to_string(), &text, overrides)
}

/// A case as stated: it obeys the schema and the checks, whether or not this build can run it.
#[derive(Clone, Debug)]
pub struct Stated {
    file: String,
    text: String,
    /// The case, before its sweeps are applied.
    pub case: Case,
    /// Its variants.
    pub variants: Vec<sweep::Variant>,
}

impl Stated {
    /// Reads a case from text; `file` is its name in messages.
    ///
    /// # Errors
    /// As [`read`].
    pub fn parse(file: &str, text: &str, overrides: &[String]) -> Result<Self, Error> {
        if text.trim().is_empty() {
            return Err(Error::Empty { file: file.to_owned() });
        }
        let parse_error = |error: toml::de::Error| Error::Parse { file: file.to_owned(), message: error.to_string() };
        // The text itself is read first: its errors know their line.
        let mut case: Case = toml::from_str(text).map_err(parse_error)?;
        let mut table: toml::Table = toml::from_str(text).map_err(parse_error)?;
        if !overrides.is_empty() {
            sweep::override_keys(&mut table, overrides)
                .map_err(|problem| Error::Invalid { file: file.to_owned(), line: 0, problem })?;
            case = table.clone().try_into().map_err(parse_error)?;
        }
        let mut stated = Self { file: file.to_owned(), text: text.to_owned(), case, variants: Vec::new() };
        stated.refuse(&stated.file, check::sweeps(&stated.case))?;
        stated.variants = sweep::variants(file, &table, &stated.case)?;
        for variant in &stated.variants {
            let file = if variant.name.is_empty() { file.to_owned() } else { format!("{file} ({})", variant.name) };
            stated.refuse(&file, check::case(&variant.case))?;
        }
        Ok(stated)
    }

    /// Prepares the scenes that this build runs.
    ///
    /// # Errors
    /// The case asks for what this build does not compute, or its start state or time step is not allowed.
    pub fn load(self) -> Result<Loaded, Error> {
        let mut scenes = Vec::new();
        for variant in &self.variants {
            let file =
                if variant.name.is_empty() { self.file.clone() } else { format!("{} ({})", self.file, variant.name) };
            for refinement in 0..=variant.case.time.refinements {
                match scene::prepare(&variant.case, &variant.name, refinement) {
                    Ok(scene) => scenes.push(scene),
                    Err(problem) => self.refuse(&file, vec![problem])?,
                }
            }
        }
        Ok(Loaded { case: self.case, variants: self.variants, scenes })
    }

    fn refuse(&self, file: &str, problems: Vec<crate::error::Problem>) -> Result<(), Error> {
        match problems.into_iter().next() {
            None => Ok(()),
            Some(problem) => {
                Err(Error::Invalid { file: file.to_owned(), line: line_of(&self.text, &problem.key), problem })
            }
        }
    }
}

/// Line of a key such as `particles.0.radius`, or of its nearest parent that stands in the text; 0 if none does.
fn line_of(text: &str, key: &str) -> usize {
    let Ok(document) = toml_edit::Document::parse(text) else { return 0 };
    let mut item = document.as_item();
    let mut span = None;
    for part in key.split('.') {
        let next = match part.parse::<usize>() {
            Ok(index) => item.get(index),
            Err(_) => item.get(part),
        };
        let Some(next) = next else { break };
        item = next;
        span = item.span().or(span);
    }
    span.map_or(0, |range| text[..range.start].bytes().filter(|byte| *byte == b'\n').count() + 1)
}
