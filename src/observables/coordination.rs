//! Coordination, rattlers, fragments and overlaps, from the contacts by geometry.
//!
//! The mean coordination is Z = (contacts of the N particles of a region, each pair counted at both) / N. A rattler has
//! fewer than a stated number of contacts with bodies and with particles that are no rattlers; they are removed until none
//! is left (C. S. O'Hern et al., *Phys. Rev. E* 68 (2003) 011306). Four contacts hold a sphere with friction at least: six
//! equations of balance and three unknowns for each contact, shared by two, leave d + 1 = 4 in three dimensions.

use super::forces::statistic;
use super::region::Part;
use super::sample::Sample;
use crate::case::measure::{Region, Statistic};

/// Contacts per particle; NaN where the region holds none [-].
///
/// # Errors
/// The region is not computed.
pub fn coordination(sample: &Sample, region: &Region, bodies: bool) -> Result<f64, String> {
    mean(sample, region, &vec![true; sample.centers().len()], bodies)
}

/// Contacts per particle among those that are no rattlers; NaN where there are none [-].
///
/// # Errors
/// The region is not computed.
pub fn without_rattlers(sample: &Sample, region: &Region, fewest: u32, bodies: bool) -> Result<f64, String> {
    mean(sample, region, &held(sample, fewest), bodies)
}

/// Rattlers over particles; NaN where there are none [-].
///
/// # Errors
/// The region is not computed.
pub fn rattler_share(sample: &Sample, region: &Region, fewest: u32) -> Result<f64, String> {
    let part = Part::new(region, sample)?;
    let held = held(sample, fewest);
    let inside = || (0..held.len()).filter(|i| part.holds(sample, &sample.centers()[*i]));
    Ok(inside().filter(|i| !held[*i]).count() as f64 / inside().count() as f64)
}

/// Mean number of contacts of the particles of a region that are `kept`, with others that are.
fn mean(sample: &Sample, region: &Region, kept: &[bool], bodies: bool) -> Result<f64, String> {
    let part = Part::new(region, sample)?;
    let touching = sample.touching();
    let mut contacts = vec![0u32; kept.len()];
    for [i, j] in touching.pairs.iter().filter(|pair| pair.iter().all(|k| kept[*k])) {
        contacts[*i] += 1;
        contacts[*j] += 1;
    }
    if bodies {
        touching.walls.iter().for_each(|[i, _]| contacts[*i] += 1);
    }
    let (mut total, mut count) = (0u64, 0u64);
    for i in (0..kept.len()).filter(|i| kept[*i] && part.holds(sample, &sample.centers()[*i])) {
        total += u64::from(contacts[i]);
        count += 1;
    }
    Ok(total as f64 / count as f64)
}

/// Which particles are no rattlers.
#[must_use]
pub fn held(sample: &Sample, fewest: u32) -> Vec<bool> {
    let touching = sample.touching();
    let count = sample.centers().len();
    let (mut contacts, mut others) = (vec![0u32; count], vec![Vec::new(); count]);
    for [i, j] in &touching.pairs {
        contacts[*i] += 1;
        contacts[*j] += 1;
        others[*i].push(*j);
        others[*j].push(*i);
    }
    touching.walls.iter().for_each(|[i, _]| contacts[*i] += 1);
    let mut held: Vec<_> = contacts.iter().map(|contacts| *contacts >= fewest).collect();
    let mut removed: Vec<_> = (0..count).filter(|i| !held[*i]).collect();
    while let Some(i) = removed.pop() {
        for j in &others[i] {
            contacts[*j] -= 1;
            if held[*j] && contacts[*j] < fewest {
                held[*j] = false;
                removed.push(*j);
            }
        }
    }
    held
}

/// Particles in the largest set that contacts hold together, over all particles [-].
#[must_use]
pub fn largest_fragment(sample: &Sample) -> f64 {
    fn top(above: &mut [usize], mut of: usize) -> usize {
        while above[of] != of {
            above[of] = above[above[of]];
            of = above[of];
        }
        of
    }
    let count = sample.centers().len();
    let mut above: Vec<_> = (0..count).collect();
    for [i, j] in &sample.touching().pairs {
        let (first, second) = (top(&mut above, *i), top(&mut above, *j));
        above[first] = second;
    }
    let mut size = vec![0u32; count];
    for i in 0..count {
        size[top(&mut above, i)] += 1;
    }
    f64::from(size.into_iter().max().unwrap_or_default()) / count as f64
}

/// A number of the distribution of overlaps over sums of radii [-].
#[must_use]
pub fn overlaps(sample: &Sample, of: Statistic) -> f64 {
    statistic(&sample.touching().overlaps, of)
}
