//! One file per command.

pub(crate) mod bench;
pub(crate) mod compare;
pub(crate) mod completions;
pub(crate) mod fit;
pub(crate) mod grow;
pub(crate) mod hello;
pub(crate) mod plant;
pub(crate) mod reference;
pub(crate) mod render;
pub(crate) mod scenes;
pub(crate) mod show;
pub(crate) mod simulate;
