//! The law of long-time sintering, one contact at a time.

use numpy::{IntoPyArray, PyReadonlyArray1};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use pyo3::types::PyDict;

use crate::case::model::{NormalLaw as Stated, TangentialLaw};
use crate::case::scene::{Mirror, SceneModel};
use crate::laws::normal::luding_sintering::LudingSintering;
use crate::laws::registry::Normal;
use crate::laws::{Approach, NormalLaw, PairLaw, Surroundings};

#[expect(clippy::needless_pass_by_value, reason = "map_err hands over owned errors")]
fn refuse<R: ToString>(reason: R) -> PyErr {
    PyValueError::new_err(reason.to_string())
}

fn law(json: &str) -> PyResult<LudingSintering> {
    let normal: Stated = serde_json::from_str(json).map_err(refuse)?;
    let model = SceneModel {
        normal,
        tangential: TangentialLaw::Frictionless {},
        moments: crate::case::model::MomentLaw::Free {},
    };
    let laws = model.specification(&Mirror::default()).map_err(refuse)?;
    match laws.normal {
        Normal::LudingSintering(law) => Ok(law),
        _ => Err(refuse("law: expected luding_sintering")),
    }
}

fn values(array: &PyReadonlyArray1<'_, f64>) -> PyResult<Vec<f64>> {
    Ok(array.as_slice().map_err(refuse)?.to_vec())
}

/// Drives one contact of the law (a case's `[model.normal]` as JSON) through overlaps [m] at loading stiffnesses [N/m].
/// Returns arrays: `force` [N] without the dashpot, `largest_overlap` [m], `stiffness` [N/m] and plastic `offset` [m].
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "Python hands over owned arguments")]
#[pyo3(signature = (law, overlaps, loading_stiffness, cohesive = true))]
pub fn sintering_contact<'py>(
    py: Python<'py>,
    law: &str,
    overlaps: PyReadonlyArray1<'py, f64>,
    loading_stiffness: PyReadonlyArray1<'py, f64>,
    cohesive: bool,
) -> PyResult<Bound<'py, PyDict>> {
    let law = self::law(law)?;
    let (overlaps, stiffnesses) = (values(&overlaps)?, values(&loading_stiffness)?);
    if overlaps.len() != stiffnesses.len() {
        let lengths = format!("{} and {}", overlaps.len(), stiffnesses.len());
        return Err(refuse(format!("overlaps and loading_stiffness have the lengths {lengths}: expected equal ones")));
    }
    if let Some(wrong) = stiffnesses.iter().find(|value| !(**value > 0.0 && **value <= law.k1)) {
        let most = law.k1;
        return Err(refuse(format!("loading_stiffness = {wrong} N/m: above 0, at most k1 = {most} N/m")));
    }
    let pair = PairLaw { cohesive, ..PairLaw::default() };
    let (mut largest, mut before) = (0.0, stiffnesses.first().copied().unwrap_or_default());
    let mut columns: [Vec<f64>; 4] = Default::default();
    for (overlap, loading) in overlaps.into_iter().zip(stiffnesses) {
        let mut force = 0.0;
        if overlap > 0.0 {
            let approach = Approach { overlap, normal_velocity: 0.0, radii: [1.0; 2], at_body: false };
            let shared = (loading, before);
            if law.renews(&shared) {
                law.renew(&shared, &mut largest);
            }
            force = law.evaluate(&pair, &approach, &shared, &mut largest).elastic;
        } else {
            largest = 0.0;
        }
        before = loading;
        let stiffness = law.branches().stiffness(largest);
        let offset = law.offset(largest, loading).min(law.fluid_overlap);
        for (column, value) in columns.iter_mut().zip([force, largest, stiffness, offset]) {
            column.push(value);
        }
    }
    let found = PyDict::new(py);
    for (name, column) in ["force", "largest_overlap", "stiffness", "offset"].into_iter().zip(columns) {
        found.set_item(name, column.into_pyarray(py))?;
    }
    Ok(found)
}

/// k1(T,t) [N/m] at the end of steps `dt` [s], from that of the first temperature [K]; one temperature and one relaxation
/// time [s] for each step.
#[pyfunction]
#[expect(clippy::needless_pass_by_value, reason = "Python hands over owned arguments")]
pub fn sintering_stiffness<'py>(
    py: Python<'py>,
    law: &str,
    temperatures: PyReadonlyArray1<'py, f64>,
    relaxation_times: PyReadonlyArray1<'py, f64>,
    dt: PyReadonlyArray1<'py, f64>,
) -> PyResult<Bound<'py, pyo3::PyAny>> {
    let law = self::law(law)?;
    let (temperatures, times, steps) = (values(&temperatures)?, values(&relaxation_times)?, values(&dt)?);
    if temperatures.len() != times.len() || times.len() != steps.len() {
        return Err(refuse("temperatures, relaxation_times and dt have different lengths: expected equal ones"));
    }
    let (mut shared, mut before) = ((0.0, 0.0), temperatures.first().copied().unwrap_or_default());
    let mut found = Vec::with_capacity(steps.len());
    for ((temperature, time), step) in temperatures.into_iter().zip(times).zip(steps) {
        let surroundings = Surroundings { temperature, temperature_before: before, relaxation_time: Some(time) };
        law.advance(&mut shared, &surroundings, step);
        before = temperature;
        found.push(shared.0);
    }
    Ok(found.into_pyarray(py).into_any())
}
