//! Work on many things, on all cores where the feature is on. The order of the answers is that of the things.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// Runs `work` over the items.
pub(crate) fn each<T: Send, R: Send>(items: Vec<T>, work: impl Fn(T) -> R + Sync + Send) -> Vec<R> {
    #[cfg(feature = "parallel")]
    return items.into_par_iter().with_max_len(1).map(work).collect();
    #[cfg(not(feature = "parallel"))]
    items.into_iter().map(work).collect()
}
