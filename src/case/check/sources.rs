//! Where particles come from, and which pairs of materials can touch.

use super::Checker;
use crate::case::protocol::Action;
use crate::case::quantity::Length;
use crate::case::schema::{Boundary, Geometry};
use crate::case::source::{ParticleSource, RadiusDistribution};

impl Checker<'_> {
    pub(super) fn sources(&mut self) {
        let case = self.case;
        for (i, source) in case.particles.iter().enumerate() {
            self.source(&format!("particles.{i}"), source);
        }
        match (&case.start_from, case.particles.is_empty()) {
            (None, true) => self.add("particles", "nothing", "a case states [[particles]] or start_from"),
            (Some(start), false) => {
                self.add("start_from", &start.case, "a case states [[particles]] or start_from, not both");
            }
            _ => {}
        }
        if let Some(at) = case.start_from.as_ref().and_then(|start| start.at) {
            self.not_negative("start_from.at", at);
        }
    }

    pub(super) fn source(&mut self, at: &str, source: &ParticleSource) {
        let material = source.material();
        if self.known_material(format!("{at}.material"), material) && self.is_rigid(material) {
            self.add(format!("{at}.material"), material, "a particle has mass: its material is not rigid");
        }
        if source.draws() && self.case.ensemble.is_none() {
            let allowed = format!("{at} draws random numbers: the case states [ensemble] with its seeds");
            self.add("ensemble", "nothing", allowed);
        }
        match source {
            ParticleSource::Single { radius, position, .. } => {
                self.positive(format!("{at}.radius"), *radius);
                self.inside(&format!("{at}.position"), position);
            }
            ParticleSource::Random { count, radius, region, velocity, .. } => {
                self.many(at, *count, radius);
                self.region(at, region);
                self.not_negative(format!("{at}.velocity"), *velocity);
            }
            ParticleSource::Ballistic { count, radius, aggregate, region, .. } => {
                self.many(at, *count, radius);
                if *aggregate == 0 || aggregate > count {
                    self.add(format!("{at}.aggregate"), aggregate, "from 1 to the number of particles");
                }
                self.region(at, region);
            }
            ParticleSource::Aggregate { count, radius, sticking, region, .. } => {
                self.many(at, *count, radius);
                let allowed = |value| value > 0.0 && value <= 1.0;
                self.number(format!("{at}.sticking"), *sticking, allowed, "a probability above 0, at most 1");
                self.region(at, region);
            }
            ParticleSource::Lattice { count, radius, origin, spacing, noise, .. } => {
                let total = count.iter().fold(1u32, |product, count| product.saturating_mul(*count));
                self.many(at, total, radius);
                self.inside(&format!("{at}.origin"), origin);
                self.positive(format!("{at}.spacing"), *spacing);
                self.not_negative(format!("{at}.noise"), *noise);
                let last = std::array::from_fn(|axis| {
                    Length::new(origin[axis].si() + spacing.si() * f64::from(count[axis].saturating_sub(1)))
                });
                self.sites(at, [origin, &last], *noise);
            }
            ParticleSource::File { .. } => {}
        }
    }

    fn many(&mut self, at: &str, count: u32, radius: &RadiusDistribution) {
        const MOST: u32 = 100_000_000;
        if count == 0 || count > MOST {
            self.add(format!("{at}.count"), count, format!("from 1 to {MOST} particles"));
        }
        match radius {
            RadiusDistribution::Equal { value } => self.positive(format!("{at}.radius.value"), *value),
            RadiusDistribution::Uniform { min, max } => {
                self.positive(format!("{at}.radius.min"), *min);
                if max < min {
                    self.add(
                        format!("{at}.radius.max"),
                        format!("{max:?}"),
                        format!("must not be below min = {min:?}"),
                    );
                }
            }
        }
    }

    fn region(&mut self, at: &str, region: &[[Length; 3]; 2]) {
        let keys = [format!("{at}.region.0"), format!("{at}.region.1")];
        let mut upper = region[1];
        if matches!(self.case.geometry, Geometry::Disks { .. }) && region[0][1] == upper[1] {
            // Disks have one place across their plane.
            upper[1] = self.case.domain.max[1];
        }
        self.corners([&keys[0], &keys[1]], &region[0], &upper);
        self.inside(&keys[0], &region[0]);
        self.inside(&keys[1], &region[1]);
    }

    fn inside(&mut self, at: &str, point: &[Length; 3]) {
        let domain = &self.case.domain;
        for (axis, coordinate) in point.iter().enumerate() {
            let (low, high) = (domain.min[axis], domain.max[axis]);
            if *coordinate < low || *coordinate > high {
                let allowed = format!("outside its box, which reaches from {low:?} to {high:?}");
                self.add(format!("{at}.{axis}"), format!("{coordinate:?}"), allowed);
            }
        }
    }

    /// A lattice and its noise stay inside the open faces of the box; noise may cross a periodic face.
    fn sites(&mut self, at: &str, [first, last]: [&[Length; 3]; 2], noise: Length) {
        let domain = &self.case.domain;
        for axis in 0..3 {
            let (low, high) = (domain.min[axis], domain.max[axis]);
            let noise = if domain.boundary[axis] == Boundary::Open { noise.si() } else { 0.0 };
            let allowed =
                |side| format!("the {side} site lies outside the box, which reaches from {low:?} to {high:?}");
            let lowest = Length::new(first[axis].si() - noise);
            if lowest < low && first[axis] >= low {
                self.add(format!("{at}.noise"), format!("reaches {lowest:?} along axis {axis}"), allowed("first"));
            }
            let highest = Length::new(last[axis].si() + noise);
            if highest > high {
                self.add(format!("{at}.spacing"), format!("reaches {highest:?} along axis {axis}"), allowed("last"));
            }
        }
    }

    /// Every pair that can touch must be stated.
    pub(super) fn missing_pairs(&mut self) {
        let case = self.case;
        let deposited = case.stages.iter().flat_map(|stage| &stage.actions).filter_map(|action| match action {
            Action::Deposit { particles } => Some(particles),
            _ => None,
        });
        let sources: Vec<&ParticleSource> = case.particles.iter().chain(deposited).collect();
        let mut touching = Vec::new();
        for (i, source) in sources.iter().enumerate() {
            let first = source.material();
            if source.makes_many() {
                touching.push((first, first));
            }
            touching.extend(sources[i + 1..].iter().map(|second| (first, second.material())));
            touching.extend(case.bodies.iter().map(|body| (first, body.material.as_str())));
        }
        let missing = touching.into_iter().find(|(a, b)| {
            !case.pairs.iter().any(|pair| {
                let [c, d] = &pair.between;
                (c == a && d == b) || (c == b && d == a)
            })
        });
        if let Some((a, b)) = missing {
            let allowed = "every pair of materials that can touch is stated";
            self.add("pairs", format!("nothing between {a} and {b}"), allowed);
        }
    }
}
