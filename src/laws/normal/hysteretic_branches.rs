//! The branches of a hysteretic linear contact: the stiffness and the force that laws with k1, k2 and kc share. Symbols and
//! equations: [`super::luding_hysteretic`].

use serde::{Deserialize, Serialize};

/// How the largest overlap follows the limit of cohesion.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Rule {
    /// The unloading branch through the present point.
    SelfConsistent,
    /// The branch of the old stiffness.
    OldStiffness,
    /// YADE's.
    LudingPm,
}

/// The stiffnesses of a contact.
#[derive(Clone, Copy, Debug)]
pub struct Branches {
    /// k1 [N/m].
    pub loading: f64,
    /// kp [N/m].
    pub unloading: f64,
    /// kc [N/m].
    pub cohesive: f64,
    /// Overlap l of the largest unloading stiffness [m].
    pub limit: f64,
}

impl Branches {
    /// k2 at a largest overlap [N/m].
    #[must_use]
    #[inline(always)]
    pub fn stiffness(&self, largest: f64) -> f64 {
        if largest >= self.limit {
            self.unloading
        } else {
            // The slope is the same for all contacts: it is divided once.
            self.loading + (self.unloading - self.loading) / self.limit * largest
        }
    }

    /// The elastic force at an overlap [N], with the largest overlap [m] that is known, which it updates.
    #[inline(always)]
    pub(super) fn force(&self, overlap: f64, largest: &mut f64, rule: Rule) -> f64 {
        let (k1, kc) = (self.loading, self.cohesive);
        *largest = largest.max(overlap);
        let stiffness = self.stiffness(*largest);
        let corner = largest.min(self.limit);
        let line = stiffness * (overlap - corner) + k1 * corner;
        if *largest < self.limit && line >= k1 * overlap {
            k1 * overlap
        } else if line > -kc * overlap {
            line
        } else {
            *largest = if rule == Rule::SelfConsistent {
                let root = 4.0 * (k1 + kc) * overlap * self.limit / (self.unloading - k1);
                0.5 * (overlap + (overlap * overlap + root).sqrt())
            } else {
                (stiffness + kc) / (stiffness - k1) * overlap
            };
            -kc * overlap
        }
    }

    /// YADE's rules: the force [N] from the overlap and the last one [m], with its largest overlap and offset d0 [m].
    ///
    /// At bodies, where l = 0, YADE divides 0 by 0 while m = 0: k2 and d0 are then no numbers, every comparison with them
    /// is false and no branch gives a force. d0 stays so, here as an infinite offset, until the overlap next exceeds m.
    pub(super) fn yade(&self, overlap: f64, last: f64, depth: f64, largest: &mut f64, offset: &mut f64) -> f64 {
        let (k1, kc) = (self.loading, self.cohesive);
        if self.limit == 0.0 && *largest == 0.0 {
            if overlap > 0.0 {
                (*largest, *offset) = (overlap, f64::INFINITY);
            }
            return 0.0;
        }
        let stiffness = self.stiffness(*largest);
        let shift = |largest: f64| ((1.0 - k1 / stiffness) * largest).min(depth);
        if overlap > *largest {
            *largest = overlap;
            *offset = shift(overlap);
        }
        if offset.is_infinite() {
            return 0.0;
        }
        let line = stiffness * (overlap - *offset);
        if line >= k1 * overlap {
            return if overlap < self.limit { k1 * overlap } else { line };
        }
        if line > -kc * overlap || overlap >= last {
            return line;
        }
        *largest = overlap * (stiffness + kc) / (stiffness - k1);
        *offset = shift(*largest);
        -kc * overlap
    }

    /// Plastic loss as the largest overlap goes from `old` to `new` [J].
    pub(super) fn plastic(&self, old: f64, new: f64) -> f64 {
        let (k1, kc) = (self.loading, self.cohesive);
        let grown = |largest: f64| {
            let largest = largest.min(self.limit);
            0.5 * k1 * largest * largest * (1.0 - k1 / self.stiffness(largest))
        };
        let fallen = |largest: f64| {
            let (largest, stiffness) = (largest.min(self.limit), self.stiffness(largest));
            let least = (stiffness - k1) / (stiffness + kc) * largest;
            0.5 * kc * least * least * (1.0 + kc / stiffness)
        };
        if new > old { grown(new) - grown(old) } else { fallen(old) - fallen(new) }
    }
}
