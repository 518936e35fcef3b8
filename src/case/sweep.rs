//! Sweeps and overrides: keys of a case replaced before it is read.

use serde::Serialize;
use toml::{Table, Value};

use super::CaseText;
use super::gate::Gate;
use super::schema::{Case, Vary};
use crate::error::{Error, Problem};

/// One point of the sweep.
#[derive(Clone, Debug, Serialize)]
pub struct Variant {
    /// Labels of its points, joined by commas; empty for a case without sweeps.
    pub name: String,
    /// Axis, label and position of each point.
    pub points: Vec<Point>,
    /// Whether only the full form of a suite runs it: one of its points says so.
    pub full_only: bool,
    /// Index of the point on each axis.
    #[serde(skip)]
    pub chosen: Vec<usize>,
    /// Its gates.
    pub gates: Vec<Gate>,
    /// The case at this point.
    #[serde(skip)]
    pub case: Case,
}

/// Where a variant stands on one axis.
#[derive(Clone, Debug, Serialize)]
pub struct Point {
    /// Name of the axis.
    pub axis: String,
    /// Label.
    pub label: String,
    /// Position on the axis [-].
    pub at: Option<f64>,
}

impl Variant {
    /// Seeds of its ensemble; one run without a seed if it has none.
    #[must_use]
    pub fn seeds(&self) -> Vec<Option<u64>> {
        match &self.case.ensemble {
            Some(ensemble) => ensemble.seeds.iter().copied().map(Some).collect(),
            None => vec![None],
        }
    }

    /// How messages name it: its points, or nothing for a case without sweeps.
    #[must_use]
    pub fn origin(&self) -> String {
        if self.name.is_empty() { String::new() } else { format!("variant {}", self.name) }
    }
}

/// A key replaced on the command line.
#[derive(Clone, Debug)]
pub struct Override {
    /// Path of the key.
    pub key: String,
    /// The new value.
    pub value: Value,
}

impl Override {
    /// How messages name it.
    pub fn origin(&self) -> String {
        format!("override {}={}", self.key, self.value)
    }
}

/// Reads overrides of the form `key=value`; a value that is not TOML is taken as a string.
pub fn parse_overrides(overrides: &[String]) -> Result<Vec<Override>, Problem> {
    let read = |text: &String| {
        let malformed = || Problem::new("override", text, "expected the form key=value");
        let (key, value) = text.split_once('=').ok_or_else(malformed)?;
        let (key, value) = (key.trim(), value.trim());
        if key.is_empty() || value.is_empty() || key.split('.').any(str::is_empty) {
            return Err(malformed());
        }
        let typed = format!("value = {value}").parse::<Table>().ok().and_then(|mut table| table.remove("value"));
        Ok(Override { key: key.to_owned(), value: typed.unwrap_or_else(|| Value::String(value.to_owned())) })
    };
    overrides.iter().map(read).collect()
}

/// Every combination of the points of all axes, read and typed.
pub fn variants(text: &CaseText, table: &Table, case: &Case) -> Result<Vec<Variant>, Error> {
    combinations(&case.vary).into_iter().map(|chosen| variant(text, table, case, &chosen)).collect()
}

fn variant(text: &CaseText, base: &Table, case: &Case, chosen: &[usize]) -> Result<Variant, Error> {
    let mut table = base.clone();
    let mut points = Vec::new();
    let chosen_points = || case.vary.iter().zip(chosen).map(|(axis, index)| (axis, &axis.points[*index]));
    for (axis, point) in chosen_points() {
        points.push(Point {
            axis: axis.axis.clone(),
            label: point.label.clone(),
            at: point.at.map(super::quantity::Number::get),
        });
    }
    let name = points.iter().map(|point| point.label.as_str()).collect::<Vec<_>>().join(",");
    let full_only = chosen_points().any(|(_, point)| point.full_only);
    let gates = Vec::new();
    let mut variant = Variant { name, points, full_only, chosen: chosen.to_vec(), gates, case: case.clone() };
    for (key, value) in chosen_points().flat_map(|(_, point)| &point.set) {
        replace(&mut table, key, value.clone()).map_err(|problem| text.invalid(Some(&variant), problem))?;
    }
    variant.case = match typed(&table) {
        Ok(case) => case,
        Err(error) => {
            let sets = || chosen_points().flat_map(|(_, point)| &point.set);
            let key = sets().find(|(key, value)| !alone(base, key, value)).or_else(|| sets().last());
            let key = key.map_or_else(String::new, |(key, _)| key.clone());
            let place = text.place(Some(&variant), &key);
            return Err(Error::Malformed { place, key, message: toml::de::Error::message(&error).to_owned() });
        }
    };
    variant.gates.clone_from(&variant.case.gates);
    Ok(variant)
}

/// Whether the case is still one with this key replaced and no other.
pub fn alone(base: &Table, key: &str, value: &Value) -> bool {
    let mut table = base.clone();
    replace(&mut table, key, value.clone()).is_ok() && typed(&table).is_ok()
}

/// The case that a table holds. It is read as text, as files are: a second reader of tables would double what the compiler
/// makes of the schema.
pub fn typed(table: &Table) -> Result<Case, toml::de::Error> {
    toml::from_str(&table.to_string())
}

/// Indices of the points, the last axis running fastest.
fn combinations(axes: &[Vary]) -> Vec<Vec<usize>> {
    axes.iter().fold(vec![Vec::new()], |heads, axis| {
        heads
            .iter()
            .flat_map(|head| (0..axis.points.len()).map(move |index| [head.as_slice(), &[index]].concat()))
            .collect()
    })
}

/// Puts `value` at a path such as `pairs.0.values.friction`; all but its last part must exist.
pub fn replace(table: &mut Table, key: &str, value: Value) -> Result<(), Problem> {
    let shown = value.to_string();
    let (first, rest) = key.split_once('.').map_or((key, None), |(first, rest)| (first, Some(rest)));
    let failed = match rest {
        None => {
            table.insert(first.to_owned(), value);
            None
        }
        Some(rest) => match table.get_mut(first) {
            Some(next) => put(next, rest, value).err(),
            None => Some(first.to_owned()),
        },
    };
    failed.map_or(Ok(()), |part| {
        Err(Problem::new(
            key,
            shown,
            format!("the case has no `{part}` there; a path names keys that stand in the case"),
        ))
    })
}

/// Puts `value` below `place`; the error is the part of the path that does not exist.
fn put(place: &mut Value, path: &str, value: Value) -> Result<(), String> {
    let (part, rest) = path.split_once('.').map_or((path, None), |(part, rest)| (part, Some(rest)));
    if let (Value::Table(inner), None) = (&mut *place, rest) {
        inner.insert(part.to_owned(), value);
        return Ok(());
    }
    let next = match place {
        Value::Table(inner) => inner.get_mut(part),
        Value::Array(items) => part.parse::<usize>().ok().and_then(|index| items.get_mut(index)),
        _ => None,
    };
    match (next, rest) {
        (None, _) => Err(part.to_owned()),
        (Some(next), None) => {
            *next = value;
            Ok(())
        }
        (Some(next), Some(rest)) => put(next, rest, value),
    }
}
