//! The case file: schema, sweeps, checks, and the scenes that come of it.

mod check;
pub mod gate;
mod locate;
pub mod measure;
pub mod model;
pub mod protocol;
pub mod quantity;
pub mod scene;
pub mod schema;
pub mod source;
mod sweep;

use std::path::Path;

use serde::Serialize;

use crate::error::{Error, Place, Problem};
use scene::Scene;
use schema::Case;

/// A case with everything that follows from it.
#[derive(Clone, Debug, Serialize)]
pub struct Loaded {
    /// The case as stated.
    pub case: Case,
    /// Its variants, in the order of the sweep.
    pub variants: Vec<sweep::Variant>,
    /// Runnable scenes: variants, each with its seeds, each with its refinements.
    pub scenes: Vec<Scene>,
}

/// The JSON schema of the case file.
#[must_use]
pub fn json_schema() -> serde_json::Value {
    schemars::schema_for!(Case).to_value()
}

/// The name by which a case chooses a law or a kind.
fn tag(value: &impl Serialize, key: &str) -> String {
    let json = serde_json::to_value(value).unwrap_or_default();
    json.get(key).and_then(serde_json::Value::as_str).unwrap_or_default().to_owned()
}

/// Reads and checks a case file. `overrides` are `key=value` pairs such as `time.step.value="1e-8 s"`.
///
/// # Errors
/// The file cannot be read, is not a case, or states what the physics does not allow.
pub fn read(path: &Path, overrides: &[String]) -> Result<Stated, Error> {
    let bytes = std::fs::read(path).map_err(|reason| Error::Read { file: path.to_owned(), reason })?;
    let file = path.display().to_string();
    let text = match std::str::from_utf8(&bytes) {
        Ok(text) => text,
        Err(error) => {
            let at = error.valid_up_to();
            let place = Place { file, line: locate::line_at(&bytes, at), origin: String::new() };
            return Err(Error::NotText { place, byte: bytes[at] });
        }
    };
    Stated::parse(&file, text, overrides)
}

/// A case as stated: it obeys the schema and the checks, whether or not this build can run it.
#[derive(Clone, Debug)]
pub struct Stated {
    text: CaseText,
    /// The case, before its sweeps are applied.
    pub case: Case,
    /// Its variants.
    pub variants: Vec<sweep::Variant>,
    /// Overrides as they were given.
    given: Vec<String>,
}

/// Overrides for the case that a case starts from begin with this.
const START: &str = "start.";

impl Stated {
    /// Reads a case from text; `file` is its name in messages.
    ///
    /// # Errors
    /// As [`read`].
    pub fn parse(file: &str, text: &str, overrides: &[String]) -> Result<Self, Error> {
        if text.trim().is_empty() {
            return Err(Error::Empty { file: file.to_owned() });
        }
        let mut text = CaseText { file: file.to_owned(), text: text.to_owned(), overrides: Vec::new() };
        // The text itself is read first: its errors know their line.
        let mut case: Case = toml::from_str(&text.text).map_err(|error| text.malformed(&error))?;
        let mut table: toml::Table = toml::from_str(&text.text).map_err(|error| text.malformed(&error))?;
        let own: Vec<String> = overrides.iter().filter(|given| !given.starts_with(START)).cloned().collect();
        if !own.is_empty() {
            text.overrides = sweep::parse_overrides(&own).map_err(|problem| text.invalid(None, problem))?;
            (table, case) = text.overridden(&table)?;
        }
        if let Some(problem) = check::sweeps(&case).into_iter().next() {
            return Err(text.invalid(None, problem));
        }
        let variants = sweep::variants(&text, &table, &case)?;
        let given = overrides.to_vec();
        let stated = Self { text, case, variants, given };
        for variant in &stated.variants {
            stated.refuse(variant, |variant| check::case(&variant.case).into_iter().next())?;
        }
        Ok(stated)
    }

    /// Keeps one variant only.
    ///
    /// # Errors
    /// There is no such variant.
    pub fn only(mut self, name: &str) -> Result<Self, Error> {
        let known = self.variants.iter().map(|variant| variant.name.as_str()).collect::<Vec<_>>().join(" ");
        self.variants.retain(|variant| variant.name == name);
        if self.variants.is_empty() {
            return Err(Error::UnknownVariant { wanted: name.to_owned(), known });
        }
        Ok(self)
    }

    /// The case that this one starts from: a file of its folder, named as the case with `_` for `-`. Overrides that begin
    /// with `start.` are for it.
    ///
    /// # Errors
    /// It cannot be read.
    pub fn ancestor(&self, name: &str) -> Result<Self, Error> {
        let folder = std::path::Path::new(&self.text.file).parent().unwrap_or_else(|| std::path::Path::new(""));
        let overrides: Vec<String> =
            self.given.iter().filter_map(|given| given.strip_prefix(START)).map(str::to_owned).collect();
        read(&folder.join(name.replace('-', "_") + ".toml"), &overrides)
    }

    /// Prepares the scenes that this build runs.
    ///
    /// # Errors
    /// The case asks for what this build does not compute, or its start state or time step is not allowed.
    pub fn load(self) -> Result<Loaded, Error> {
        let mut scenes = Vec::new();
        for variant in &self.variants {
            for seed in variant.seeds() {
                for refinement in variant.case.time.levels() {
                    let prepare = |variant: &sweep::Variant| scene::start::scene(&self, variant, seed, refinement);
                    match prepare(variant) {
                        Ok(scene) => scenes.push(scene),
                        Err(_) => self.refuse(variant, |variant| prepare(variant).err())?,
                    }
                }
            }
        }
        Ok(Loaded { case: self.case, variants: self.variants, scenes })
    }

    /// Refuses a variant that has a problem; the message does not blame it for what all of them have.
    fn refuse(
        &self,
        variant: &sweep::Variant,
        problem_of: impl Fn(&sweep::Variant) -> Option<Problem>,
    ) -> Result<(), Error> {
        let Some(problem) = problem_of(variant) else { return Ok(()) };
        let shared = self.variants.iter().all(|other| problem_of(other).as_ref() == Some(&problem));
        let mut place = self.text.place(Some(variant), &problem.key);
        if shared && place.origin == variant.origin() {
            place.origin.clear();
        }
        Err(Error::Invalid { place, problem: Box::new(problem) })
    }
}

/// The text of a case with its overrides: it knows where a key was said.
#[derive(Clone, Debug)]
struct CaseText {
    file: String,
    text: String,
    overrides: Vec<sweep::Override>,
}

impl CaseText {
    fn malformed(&self, error: &toml::de::Error) -> Error {
        let located = locate::locate(&self.text, error);
        let place = Place { file: self.file.clone(), line: located.line, origin: String::new() };
        // A message of one line stays readable in a log.
        let message = error.message().lines().collect::<Vec<_>>().join(", ");
        Error::Malformed { place, key: located.key, message }
    }

    fn invalid(&self, variant: Option<&sweep::Variant>, problem: Problem) -> Error {
        Error::Invalid { place: self.place(variant, &problem.key), problem: Box::new(problem) }
    }

    /// Who said a key last: a point of the sweep, an override, or the file.
    fn place(&self, variant: Option<&sweep::Variant>, key: &str) -> Place {
        let set_by = |set: &str| set == key || key.strip_prefix(set).is_some_and(|rest| rest.starts_with('.'));
        let origin = variant.map_or_else(String::new, sweep::Variant::origin);
        let chosen = variant.map_or(&[][..], |variant| &variant.chosen);
        for (axis, &index) in chosen.iter().enumerate().rev() {
            let point = variant.and_then(|variant| variant.case.vary.get(axis)?.points.get(index));
            if let Some(set) = point.and_then(|point| point.set.keys().find(|set| set_by(set))) {
                let line = locate::line_of_set(&self.text, axis, index, set);
                return Place { file: self.file.clone(), line, origin };
            }
        }
        if let Some(given) = self.overrides.iter().rev().find(|given| set_by(&given.key)) {
            return Place { file: self.file.clone(), line: 0, origin: given.origin() };
        }
        Place { file: self.file.clone(), line: locate::line_of(&self.text, key), origin }
    }

    /// The case with its overrides; an error names the override that makes it none.
    fn overridden(&self, base: &toml::Table) -> Result<(toml::Table, Case), Error> {
        let mut table = base.clone();
        for given in &self.overrides {
            sweep::replace(&mut table, &given.key, given.value.clone())
                .map_err(|problem| self.invalid(None, problem))?;
        }
        match sweep::typed(&table) {
            Ok(case) => Ok((table, case)),
            Err(error) => {
                let alone = |given: &&sweep::Override| !sweep::alone(base, &given.key, &given.value);
                let culprit = self.overrides.iter().find(alone).or_else(|| self.overrides.last());
                let (key, origin) = culprit.map_or_else(Default::default, |given| (given.key.clone(), given.origin()));
                let place = Place { file: self.file.clone(), line: 0, origin };
                Err(Error::Malformed { place, key, message: toml::de::Error::message(&error).to_owned() })
            }
        }
    }
}
