//! The stress tensor of a region, positive in compression.
//!
//! | symbol | meaning |
//! |---|---|
//! | V | volume of the region [m3] |
//! | f, l | force on a particle [N], vector to it from the other centre or from the point of the wall [m] |
//! | m, v, w | mass [kg], velocity, and mean velocity by mass of the region [m/s] |
//!
//! The part of contacts is the sum of the dyads f l over V; that of motion the sum of m (v - w) (v - w) over V. A contact belongs to the region that
//! holds its place, with its whole branch: exact for a whole packing, and up to a layer of one radius for a part of it.
//! Source: A. E. H. Love, *Mathematical Theory of Elasticity* (1927); J. Weber, *Bulletin de liaison des Ponts et
//! Chaussées* 20 (1966) 1; J. Christoffersen, M. M. Mehrabadi, S. Nemat-Nasser, *J. Appl. Mech.* 48 (1981) 339.

use nalgebra::Matrix3;

use super::region::Part;
use super::sample::{Sample, needed};
use crate::Vector;
use crate::case::measure::{Region, StressPart};

/// The tensor, row by row [Pa]; NaN where the region is empty.
///
/// # Errors
/// The record lacks contacts or velocities, or the region is not computed.
pub fn tensor(sample: &Sample, region: &Region, of: StressPart) -> Result<Vec<f64>, String> {
    let part = Part::new(region, sample)?;
    let volume = part.volume(sample)?;
    let sum = match of {
        StressPart::Contacts => {
            let inside = sample.contacts()?.iter().filter(|contact| part.holds(sample, &contact.place));
            inside.map(|contact| contact.force * contact.branch.transpose()).sum()
        }
        StressPart::Kinetic => motion(sample, &part)?,
    };
    let scale = if volume > 0.0 { 1.0 / volume } else { f64::NAN };
    Ok((sum * scale).transpose().iter().copied().collect())
}

fn motion(sample: &Sample, part: &Part) -> Result<Matrix3<f64>, String> {
    let velocity = needed(sample.state.velocity, "velocity")?;
    let inside = || {
        let all = velocity.iter().zip(&sample.system.mass).zip(sample.centers());
        all.filter(|(_, center)| part.holds(sample, center)).map(|((v, m), _)| (Vector::from(*v), *m))
    };
    let mass: f64 = inside().map(|(_, m)| m).sum();
    let mean = inside().map(|(v, m)| v * m).sum::<Vector>() / mass;
    Ok(inside().map(|(v, m)| (v - mean) * (v - mean).transpose() * m).sum())
}
