//! Sweeps and overrides: keys of a case replaced before it is read.

use serde::Serialize;
use toml::{Table, Value};

use super::schema::{Case, Vary};
use crate::error::{Error, Problem};

/// One point of the sweep.
#[derive(Clone, Debug, Serialize)]
pub struct Variant {
    /// Labels of its points, joined by commas; empty for a case without sweeps.
    pub name: String,
    /// Axis, label and position of each point.
    pub points: Vec<Point>,
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

/// Replaces keys by `key=value` overrides; a value that is not TOML is taken as a string.
pub fn override_keys(table: &mut Table, overrides: &[String]) -> Result<(), Problem> {
    for text in overrides {
        let Some((key, value)) = text.split_once('=') else {
            return Err(Problem::new(text, "nothing", "an override has the form key=value"));
        };
        let value = format!("value = {value}")
            .parse::<Table>()
            .ok()
            .and_then(|mut table| table.remove("value"))
            .unwrap_or_else(|| Value::String(value.to_owned()));
        replace(table, key.trim(), value)?;
    }
    Ok(())
}

/// Every combination of the points of all axes, read and typed.
pub fn variants(file: &str, table: &Table, case: &Case) -> Result<Vec<Variant>, Error> {
    combinations(&case.vary)
        .into_iter()
        .map(|choice| {
            let mut table = table.clone();
            let mut points = Vec::new();
            for (axis, index) in case.vary.iter().zip(choice) {
                let point = &axis.points[index];
                for (key, value) in &point.set {
                    replace(&mut table, key, value.clone()).map_err(|problem| Error::Invalid {
                        file: format!("{file} ({})", point.label),
                        line: 0,
                        problem,
                    })?;
                }
                points.push(Point {
                    axis: axis.axis.clone(),
                    label: point.label.clone(),
                    at: point.at.map(super::quantity::Number::get),
                });
            }
            let name = points.iter().map(|point| point.label.as_str()).collect::<Vec<_>>().join(",");
            let case = table
                .try_into()
                .map_err(|error: toml::de::Error| Error::Parse { file: format!("{file} ({name})"), message: error.to_string() })?;
            Ok(Variant { name, points, case })
        })
        .collect()
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
fn replace(table: &mut Table, key: &str, value: Value) -> Result<(), Problem> {
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
        Err(Problem::new(key, shown, format!("there is no `{part}` in the case to replace a key of")))
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
