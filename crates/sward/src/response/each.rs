//! Work on many patches, on all cores where the feature is on.

#[cfg(feature = "parallel")]
use rayon::prelude::*;

/// Runs `work` over the tasks.
pub(crate) fn each<T: Send, R: Send>(tasks: Vec<T>, work: impl Fn(T) -> R + Sync + Send) -> Vec<R> {
    #[cfg(feature = "parallel")]
    return tasks.into_par_iter().map(work).collect();
    #[cfg(not(feature = "parallel"))]
    tasks.into_iter().map(work).collect()
}

/// As [`each`], with working space that each thread makes once.
pub(crate) fn each_with<T: Send, S, R: Send>(
    tasks: Vec<T>,
    space: impl Fn() -> S + Sync + Send,
    work: impl Fn(&mut S, T) -> R + Sync + Send,
) -> Vec<R> {
    #[cfg(feature = "parallel")]
    return tasks.into_par_iter().map_init(space, work).collect();
    #[cfg(not(feature = "parallel"))]
    {
        let mut space = space();
        tasks.into_iter().map(|task| work(&mut space, task)).collect()
    }
}
