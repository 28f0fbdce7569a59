//! What of a world's state was kept when its scene changed.

/// What became of one part of the state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fate {
    /// It goes on.
    Kept,
    /// It began anew, at rest; why, in words.
    Anew(&'static str),
}

impl Fate {
    /// Whether it goes on.
    #[must_use]
    pub fn is_kept(self) -> bool {
        self == Self::Kept
    }

    /// Kept, unless one of several things differs: the first of them is told.
    pub(super) fn unless(reasons: &[(bool, &'static str)]) -> Self {
        reasons.iter().find(|(differs, _)| *differs).map_or(Self::Kept, |(_, why)| Self::Anew(why))
    }
}

/// What [`super::World::rescene`] kept of the state. Time is always kept.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Kept {
    /// The ground as it was edited from code.
    pub ground: Fate,
    /// One entry per interactor of the new scene, in its order.
    pub bodies: Vec<Fate>,
    /// One entry per stand of the new scene, in its order: of grass and of meshes alike.
    pub stands: Vec<Fate>,
    /// One entry per plane of air that flows, in the order of the new scene.
    pub fluids: Vec<Fate>,
}

impl Kept {
    /// Whether everything goes on.
    #[must_use]
    pub fn is_all(&self) -> bool {
        let parts = self.bodies.iter().chain(&self.stands).chain(&self.fluids);
        parts.chain([&self.ground]).all(|fate| fate.is_kept())
    }
}
