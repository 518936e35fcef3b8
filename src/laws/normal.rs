//! Laws of the force along the normal, one per file.

pub mod hertz;
