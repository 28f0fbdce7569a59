//! The sward command line.
fn main() {}
