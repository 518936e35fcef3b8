//! What is measured during a run.

pub mod energy;
