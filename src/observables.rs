//! What is measured: energies during a run, and observables of a record.
//!
//! The observables are pure functions of columns, so that the same function measures the record of every code.
//!
//! | module | what |
//! |---|---|
//! | [`system`], [`sample`] | what does not change, and the state at one time |
//! | [`measure`] | all observables over all samples; means over the end of a stage |
//! | [`sphere_volume`], [`enclosure`], [`region`] | volumes: of parts of spheres, between walls, of regions |
//! | [`touching`] | who touches whom, by geometry |
//! | [`packing`], [`coordination`], [`forces`], [`walls`], [`stress`], [`motion`] | the observables |
//! | [`energy`] | the energy ledger of the engine |

pub mod coordination;
pub mod enclosure;
pub mod energy;
pub mod forces;
pub mod measure;
pub mod motion;
pub mod packing;
pub mod region;
pub mod sample;
pub mod sphere_volume;
pub mod stress;
pub mod system;
pub mod touching;
pub mod walls;
