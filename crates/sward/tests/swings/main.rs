//! Plants that swing by themselves: against the article, against integration, and against what players would notice.
//! Every comparison has a control that fails.

#[path = "../common/mod.rs"]
mod common;

mod field;
mod instigator;
mod jumps;
mod letting_go;
mod many;
mod poses;
mod standing;
mod tuning;
