//! Laws of rolling and twisting moments, one per file.
