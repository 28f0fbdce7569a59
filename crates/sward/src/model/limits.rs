//! What limits growth, compiled: the scene's exclusions and masks.

use std::sync::Arc;

use super::Assets;
use crate::growth::{Limit, MaskImage, Outline};
use crate::scene::{Scene, SceneError, SpeciesModel, Trail};

/// How far height follows cover in the margin of an exclusion.
const MARGIN_HEIGHT: f32 = 0.6;

/// A limit, and the names of the stands it holds for; none named: all.
pub(super) type Named = (Arc<Limit>, Vec<String>);

/// Share of all plants that belong to the stands named and are taller than `above` \[m\]: how bare the ground looks without them.
fn share_of(scene: &Scene, species: &[SpeciesModel], names: &[String], above: f32) -> f32 {
    let (mut own, mut all) = (0.0, 0.0);
    for (stand, species) in scene.stands.iter().zip(species) {
        let [low, high] = species.height;
        let taller = ((high - above) / (high - low).max(1e-3)).clamp(0.0, 1.0);
        let named = names.is_empty() || names.contains(&species.name);
        (own, all) = (own + if named { stand.cover * taller } else { 0.0 }, all + stand.cover);
    }
    if all > 0.0 { own / all } else { 1.0 }
}

/// The exclusions and masks of a scene, each with the stands it names; none named: all.
pub(super) fn of(scene: &Scene, assets: &dyn Assets) -> Result<Vec<Named>, SceneError> {
    let species = scene.stands.iter().map(crate::scene::Stand::resolve).collect::<Result<Vec<_>, _>>()?;
    let mut limits = Vec::new();
    for exclusion in &scene.exclusions {
        let limit = Limit {
            outline: Outline::of(&exclusion.area),
            soft: exclusion.soft,
            above: exclusion.above,
            height: MARGIN_HEIGHT,
            outside: 1.0,
            colour: exclusion.colour,
            share: share_of(scene, &species, &exclusion.stands, exclusion.above),
        };
        limits.push((Arc::new(limit), exclusion.stands.clone()));
    }
    for (index, mask) in scene.masks.iter().enumerate() {
        let trail = Trail::default().key("masks").index(index).key("path");
        let bytes = super::read(&mask.path, &trail, assets)?;
        let help = "export it as a grey PNG of 8 or 16 bits, at most 2048 pixels a side";
        let bad = |message: String| SceneError::in_file(&mask.path, message).named_by(trail.clone()).advise(help);
        let image = Arc::new(MaskImage::from_png(&bytes).map_err(bad)?);
        let limit = Limit {
            outline: Outline::of_mask(mask, image),
            soft: 0.0,
            above: 0.0,
            height: mask.height,
            outside: mask.outside,
            colour: mask.colour,
            share: share_of(scene, &species, &mask.stands, 0.0),
        };
        limits.push((Arc::new(limit), mask.stands.clone()));
    }
    Ok(limits)
}
