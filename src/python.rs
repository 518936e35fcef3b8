//! The Python module `crossgrain`: a thin mirror of the library.

use pyo3::prelude::*;

mod observables;
mod records;
mod sintering;

/// The native discrete element engine and the case schema.
#[pymodule(name = "crossgrain")]
#[expect(clippy::needless_pass_by_value, reason = "Python hands over owned arguments, map_err owned errors")]
mod module {
    use std::ffi::OsString;
    use std::path::PathBuf;

    use pyo3::exceptions::PyValueError;
    use pyo3::prelude::*;

    use crate::{Error, case, cli, simulation};

    #[pymodule_export]
    use super::observables::{measure, measure_units};
    #[pymodule_export]
    use super::records::run;
    #[pymodule_export]
    use super::sintering::{sintering_contact, sintering_stiffness};
    #[pymodule_export]
    #[expect(non_upper_case_globals, reason = "the name that Python gives to versions")]
    const __version__: &str = env!("CARGO_PKG_VERSION");

    #[pymodule_export]
    const OBSERVABLES: &str = env!("CROSSGRAIN_OBSERVABLES");

    fn raise(error: Error) -> PyErr {
        PyValueError::new_err(error.to_string())
    }

    /// Reads, checks and expands a case file: JSON with the keys `case`, `variants` and `scenes`.
    /// Overrides are `key=value`, with `start.` before keys of the case that it starts from; `variant` keeps one only.
    #[pyfunction]
    #[pyo3(signature = (path, overrides = Vec::new(), variant = None))]
    fn load_case(path: PathBuf, overrides: Vec<String>, variant: Option<&str>) -> PyResult<String> {
        cli::loaded_json(&path, &overrides, variant).map_err(raise)
    }

    /// Reads and checks a case file without asking whether this build can run it: JSON of the case.
    #[pyfunction]
    fn read_case(path: PathBuf) -> PyResult<String> {
        let stated = case::read(&path, &[]).map_err(raise)?;
        serde_json::to_string(&stated.case).map_err(|error| PyValueError::new_err(error.to_string()))
    }

    /// The JSON schema of the case file.
    #[pyfunction]
    fn schema() -> String {
        case::json_schema().to_string()
    }

    /// Runs a scene given as JSON and writes its record into the folder `out`. States from which scenes start are taken from
    /// the folder `states` and saved there; so are those of this run at the steps `save_at`.
    #[pyfunction]
    #[pyo3(signature = (scene, out, threads = 1, states = None, save_at = Vec::new()))]
    fn run_scene(
        py: Python<'_>,
        scene: &str,
        out: PathBuf,
        threads: usize,
        states: Option<PathBuf>,
        save_at: Vec<u64>,
    ) -> PyResult<()> {
        let scene = cli::parse_scene("scene", scene).map_err(raise)?;
        let options = simulation::Options { states, save_at, ..simulation::Options::threads(threads) };
        py.detach(|| simulation::run(&scene, &options, &|_| {})?.write(&out)).map_err(raise)
    }

    /// Runs the command line `crossgrain ARGUMENTS` and returns its exit code.
    #[pyfunction]
    fn main(py: Python<'_>, arguments: Vec<OsString>) -> u8 {
        py.detach(|| cli::run(std::iter::once(OsString::from("crossgrain")).chain(arguments)))
    }
}
