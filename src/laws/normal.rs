//! Laws of the force along the normal, one per file.

pub mod hertz;
pub mod linear_spring_dashpot;
