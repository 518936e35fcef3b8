//! Crossgrain: a discrete element code that is proved against other discrete element codes.
//!
//! # Conventions
//!
//! SI units and `f64` everywhere. Three dimensions.
//!
//! | what | sign |
//! |---|---|
//! | normal | unit vector from j to i; forces of a contact are on i |
//! | overlap | positive in contact |
//! | normal velocity | positive when approaching |
//! | damping constants | positive |
//!
//! # Map
//!
//! | module | what |
//! |---|---|
//! | [`case`] | the case file (the schema) and its expansion into scenes |
//! | [`material`] | materials and the only place of mixing rules |
//! | [`particles`], [`bodies`], [`domain`] | what moves: particles, walls; the box |
//! | [`path`] | prescribed paths of driven particles |
//! | [`geometry`], [`laws`] | contact geometry and contact laws |
//! | [`neighbors`], [`contacts`] | who may touch, and what contacts remember |
//! | [`simulation`] | one step: motion, sweep over contacts |
//! | [`observables`], [`record`] | what is measured and how it is written |
//! | [`bench`] | speed on states built from a seed |
//! | [`cli`] | the command `crossgrain` |
//!
//! # Determinism
//!
//! A run has the same bits for every number of threads and every order of its input: particles are ordered by their
//! positions, blocks of them are swept one task each, and no floating-point sum depends on scheduling.

/// A vector in three dimensions.
pub type Vector = nalgebra::Vector3<f64>;

pub mod bench;
pub mod bodies;
pub mod case;
pub mod cli;
pub mod contacts;
pub mod domain;
pub mod error;
pub mod geometry;
pub mod laws;
pub mod material;
pub mod neighbors;
pub mod observables;
pub mod particles;
pub mod path;
pub mod record;
pub mod simulation;

#[cfg(feature = "python")]
mod python;

pub use error::Error;
