//! Runs whose records Python holds as numpy arrays.

use std::path::PathBuf;

use numpy::IntoPyArray;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::record::{RecordColumn, Values};
use crate::{cli, simulation};

/// Runs a scene given as JSON; returns the header of its record as JSON, and its columns. States from which scenes start
/// are taken from the folder `states` and saved there.
#[pyfunction]
#[pyo3(signature = (scene, threads = 1, states = None))]
pub fn run<'py>(
    py: Python<'py>,
    scene: &str,
    threads: usize,
    states: Option<PathBuf>,
) -> PyResult<(String, Bound<'py, PyDict>)> {
    let refuse = |error: crate::Error| PyValueError::new_err(error.to_string());
    let scene = cli::parse_scene("scene", scene).map_err(refuse)?;
    let options = simulation::Options { states, ..simulation::Options::threads(threads) };
    let recorder = py.detach(|| simulation::run(&scene, &options, &|_| {})).map_err(refuse)?;
    let (header, columns) = recorder.finish();
    let found = PyDict::new(py);
    for RecordColumn { name, shape, values } in columns {
        let array = match values {
            Values::Real(values) => values.into_pyarray(py).into_any(),
            Values::Count(values) => values.into_pyarray(py).into_any(),
        };
        found.set_item(name, array.call_method1("reshape", (shape,))?)?;
    }
    Ok((header.to_string(), found))
}
