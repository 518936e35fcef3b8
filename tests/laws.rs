//! Contact laws against what the reference codes were measured to compute, and against independent integrations.
//!
//! Measured numbers: `docs` of the harness, runs of LIGGGHTS 3.8.0, YADE 2023.02a and LAMMPS 29 Sep 2021; every table
//! names its case.

#![allow(
    clippy::unwrap_used,
    clippy::print_stdout,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a test that cannot go on stops, and prints what it measured"
)]

#[path = "laws/collisions.rs"]
mod collisions;
#[path = "laws/invariants.rs"]
mod invariants;
#[path = "laws/ledger.rs"]
mod ledger;
#[path = "laws/micro_slip.rs"]
mod micro_slip;
#[path = "laws/moments.rs"]
mod moments;
#[path = "laws/normals.rs"]
mod normals;
#[path = "laws/scenes.rs"]
mod scenes;
#[path = "laws/sintering.rs"]
mod sintering;
