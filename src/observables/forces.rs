//! Statistics of contact forces, from recorded contacts.
//!
//! | symbol | meaning |
//! |---|---|
//! | f, n | force on the first particle [N], unit normal to it [-] |
//! | fn = f . n | normal force, positive where it pushes [N] |
//! | ft = abs(f - fn n) | tangential force [N] |
//! | mu | friction of the pair of materials [-] |
//!
//! The normal comes from the places of the particles, so that the split is the same for every code. The mobilisation is
//! ft / (mu fn), of contacts with fn > 0 and mu > 0; a contact above [`SLIDING`] counts as sliding. Where a law adds
//! adhesion to the friction cap it may pass 1. Source: the definitions; F. Radjai et al., *Phys. Rev. Lett.* 77 (1996) 274
//! for the distribution of fn over its mean.

use super::sample::{Contact, Sample};
use super::system::Partner;
use crate::case::measure::{ContactSet, MobilisationStatistic, Statistic};

/// Mobilisation above which a contact counts as sliding [-].
pub const SLIDING: f64 = 0.99;

/// A number of a distribution; NaN of no values.
#[must_use]
pub fn statistic(values: &[f64], of: Statistic) -> f64 {
    let count = values.len() as f64;
    if values.is_empty() {
        return f64::NAN;
    }
    let mean = values.iter().sum::<f64>() / count;
    match of {
        Statistic::Mean => mean,
        Statistic::StandardDeviation => {
            (values.iter().map(|value| (value - mean) * (value - mean)).sum::<f64>() / count).sqrt()
        }
        Statistic::Largest => values.iter().copied().fold(f64::NEG_INFINITY, f64::max),
        Statistic::NegativeShare => values.iter().filter(|value| **value < 0.0).count() as f64 / count,
    }
}

fn of_particles(contact: &Contact) -> bool {
    matches!(contact.partner, Partner::Particle(_))
}

fn normal_forces(sample: &Sample) -> Result<Vec<f64>, String> {
    let contacts = sample.contacts()?;
    Ok(contacts.iter().filter(|contact| of_particles(contact)).map(Contact::normal_force).collect())
}

/// A number of the distribution of the normal forces of particle contacts.
///
/// # Errors
/// The record has no contacts.
pub fn normal(sample: &Sample, of: Statistic) -> Result<f64, String> {
    Ok(statistic(&normal_forces(sample)?, of))
}

/// Probability density of normal forces over their mean in `count` classes from 0 to `up_to` means; NaN of no contacts.
///
/// # Errors
/// The record has no contacts.
pub fn distribution(sample: &Sample, count: usize, up_to: f64) -> Result<Vec<f64>, String> {
    let values = normal_forces(sample)?;
    let mean = statistic(&values, Statistic::Mean);
    let width = up_to / count as f64;
    let mut classes = vec![0.0; count];
    for value in &values {
        let at = value / mean / width;
        #[expect(clippy::cast_possible_truncation, clippy::cast_sign_loss, reason = "places below 0 are left out")]
        if at >= 0.0
            && let Some(class) = classes.get_mut(at as usize)
        {
            *class += 1.0;
        }
    }
    Ok(classes.into_iter().map(|class| class / (values.len() as f64 * width)).collect())
}

/// A number of the distribution of the mobilisation; NaN of no contacts.
///
/// # Errors
/// The record has no contacts, or the friction of a pair of materials is not stated.
pub fn mobilisation(sample: &Sample, of: MobilisationStatistic, set: ContactSet) -> Result<f64, String> {
    let (mut sum, mut sliding, mut count) = (0.0, 0u32, 0u32);
    for contact in sample.contacts()? {
        let counts = match set {
            ContactSet::All => true,
            ContactSet::Particles => of_particles(contact),
            ContactSet::Bodies => !of_particles(contact),
        };
        let normal = contact.normal_force();
        if !counts || normal <= 0.0 {
            continue;
        }
        let friction = sample.system.friction(contact.particle, contact.partner)?;
        if friction > 0.0 {
            let mobilised = contact.tangential_force().norm() / (friction * normal);
            sum += mobilised;
            sliding += u32::from(mobilised > SLIDING);
            count += 1;
        }
    }
    let total = match of {
        MobilisationStatistic::Mean => sum,
        MobilisationStatistic::SlidingShare => f64::from(sliding),
    };
    Ok(total / f64::from(count))
}
