//! Laws of the force along the normal, one per file.

pub mod cohesive;
pub mod dmt;
pub mod hertz;
pub mod hysteretic_branches;
pub mod linear_spring_dashpot;
pub mod luding_hysteretic;
pub mod luding_sintering;
pub mod sjkr;
pub mod sjkr2;
