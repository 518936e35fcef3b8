//! Observables of columns that Python holds as numpy arrays.

use numpy::{Element, IntoPyArray, PyArrayDyn, PyArrayMethods, PyReadonlyArrayDyn, PyUntypedArrayMethods};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::observables::measure::{Columns, ContactColumns, Named, Series, series};
use crate::observables::sample::Row;
use crate::observables::system::System;

const CONTACTS: [&str; 3] = ["contact_start", "contact_pair", "contact_force"];

fn refuse(message: impl std::fmt::Display) -> PyErr {
    PyValueError::new_err(message.to_string())
}

fn asked(observables: &str) -> PyResult<Vec<Named>> {
    serde_json::from_str(observables).map_err(|error| refuse(format!("observables: {error}")))
}

/// A column in C order, whose shape is checked: `None` stands for any number of samples or contacts.
fn column<'py, T: Element>(
    columns: &Bound<'py, PyDict>,
    name: &str,
    kinds: &str,
    shape: &[Option<usize>],
) -> PyResult<Option<PyReadonlyArrayDyn<'py, T>>> {
    let Some(given) = columns.get_item(name)? else { return Ok(None) };
    let numpy = columns.py().import("numpy")?;
    let given = numpy.call_method1("ascontiguousarray", (given,))?;
    let kind: String = given.getattr("dtype")?.getattr("kind")?.extract()?;
    if !kinds.contains(&kind) {
        return Err(refuse(format!("column {name} holds values of kind `{kind}`, expected one of `{kinds}`")));
    }
    let array = given.call_method1("astype", (numpy::dtype::<T>(columns.py()), "C"))?.cast_into::<PyArrayDyn<T>>()?;
    let found = array.shape();
    let fits = found.len() == shape.len() && found.iter().zip(shape).all(|(n, m)| m.is_none_or(|m| *n == m));
    if !fits {
        let length = |length: &Option<usize>| length.map_or("any".to_owned(), |length| length.to_string());
        let expected: Vec<_> = shape.iter().map(length).collect();
        return Err(refuse(format!("column {name} has the shape {found:?}, expected ({})", expected.join(", "))));
    }
    Ok(Some(array.readonly()))
}

fn values<'a, T: Element>(array: Option<&'a PyReadonlyArrayDyn<'_, T>>) -> PyResult<Option<&'a [T]>> {
    array.map(|array| array.as_slice().map_err(refuse)).transpose()
}

fn rows<'a>(array: Option<&'a PyReadonlyArrayDyn<'_, f64>>) -> PyResult<Option<&'a [Row]>> {
    Ok(values(array)?.map(|values| values.as_chunks().0))
}

/// Contact indices as the library takes them.
fn indices<T: TryFrom<i64>>(values: &[i64], name: &str) -> PyResult<Vec<T>> {
    let index = |(at, value): (usize, &i64)| {
        T::try_from(*value).map_err(|_| refuse(format!("column {name}: value {value} at {at} is no index")))
    };
    values.iter().enumerate().map(index).collect()
}

/// Measures the samples of a record.
#[pyfunction]
#[pyo3(signature = (observables, context, columns))]
pub fn measure<'py>(
    py: Python<'py>,
    observables: &str,
    context: &str,
    columns: &Bound<'py, PyDict>,
) -> PyResult<Bound<'py, PyDict>> {
    let asked = asked(observables)?;
    let system = System::parse(context).map_err(|reason| refuse(format!("context: {reason}")))?;
    let (particles, bodies) = (Some(system.radius.len()), Some(system.bodies.len()));
    let float = |name: &str, shape: &[Option<usize>]| column::<f64>(columns, name, "fiu", shape);
    let lacks = |name: &str| refuse(format!("column {name} is missing: every record has it"));
    let time = float("time", &[None])?.ok_or_else(|| lacks("time"))?;
    let samples = Some(time.len());
    let position = float("position", &[samples, particles, Some(3)])?.ok_or_else(|| lacks("position"))?;
    let of_particles = |name: &str| float(name, &[samples, particles, Some(3)]);
    let (velocity, angular_velocity) = (of_particles("velocity")?, of_particles("angular_velocity")?);
    let force = of_particles("force")?;
    let body_force = float("body_force", &[samples, bodies, Some(3)])?;
    let body_point = float("body_point", &[samples, bodies, Some(3)])?;
    let radius = float("radius", &[samples, particles])?;

    let start = column::<i64>(columns, CONTACTS[0], "iu", &[samples.map(|samples| samples + 1)])?;
    let pair = column::<i64>(columns, CONTACTS[1], "iu", &[None, Some(2)])?;
    let contact_force = float(CONTACTS[2], &[None, Some(3)])?;
    let contacts = match (values(start.as_ref())?, values(pair.as_ref())?, rows(contact_force.as_ref())?) {
        (Some(start), Some(pair), Some(force)) => {
            Some((indices::<usize>(start, CONTACTS[0])?, indices::<u32>(pair, CONTACTS[1])?, force))
        }
        (None, None, None) => None,
        _ => return Err(refuse(format!("columns {} stand together or not at all", CONTACTS.join(", ")))),
    };
    let record = Columns {
        time: time.as_slice().map_err(refuse)?,
        position: rows(Some(&position))?.unwrap_or_default(),
        velocity: rows(velocity.as_ref())?,
        angular_velocity: rows(angular_velocity.as_ref())?,
        force: rows(force.as_ref())?,
        body_force: rows(body_force.as_ref())?,
        body_point: rows(body_point.as_ref())?,
        radius: values(radius.as_ref())?,
        contacts: contacts.as_ref().map(|(start, pair, force)| ContactColumns {
            start,
            pair: pair.as_chunks().0,
            force,
        }),
    };
    let measured = py.detach(|| series(&asked, &system, &record)).map_err(refuse)?;
    let result = PyDict::new(py);
    for Series { name, width, values, .. } in measured {
        let array = values.into_pyarray(py);
        match width {
            Some(width) => result.set_item(name, array.call_method1("reshape", ((time.len(), width),))?)?,
            None => result.set_item(name, array)?,
        }
    }
    Ok(result)
}

/// SI units of observables by name; `-` for a number.
#[pyfunction]
pub fn measure_units<'py>(py: Python<'py>, observables: &str) -> PyResult<Bound<'py, PyDict>> {
    let units = PyDict::new(py);
    for named in asked(observables)? {
        units.set_item(named.name, named.measure.unit())?;
    }
    Ok(units)
}
