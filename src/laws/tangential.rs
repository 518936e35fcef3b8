//! Laws of the force in the contact plane, one per file.

pub mod mindlin;
