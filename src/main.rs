//! The command `crossgrain`: a thin shell around [`crossgrain::cli`].

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(crossgrain::cli::run(std::env::args_os()))
}
