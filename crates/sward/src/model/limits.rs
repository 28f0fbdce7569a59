//! What limits growth, compiled: the scene's exclusions and masks.

use std::sync::Arc;

use super::Assets;
use crate::growth::{Comb, DirectionImage, Limit, MaskImage, Outline};
use crate::scene::{Scene, SceneError, SpeciesModel, Trail};

/// How far height follows cover in the margin of an exclusion.
const MARGIN_HEIGHT: f32 = 0.6;

/// A limit, and the names of the stands it holds for; none named: all.
pub(super) type Named = (Arc<Limit>, Vec<String>);

/// The same of how it lies.
pub(super) type NamedComb = (Arc<Comb>, Vec<String>);

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

const GREY: &str = "export it as a grey PNG of 8 or 16 bits, at most 2048 pixels a side";
const COLOUR: &str = "export it as an RGB PNG of 8 bits, at most 2048 pixels a side: (128, 128, 255) is upright";

/// A picture of a mask, if the scene names one; `help` is what to do about a bad one.
fn picture<T>(
    path: &str,
    trail: Trail,
    assets: &dyn Assets,
    help: &str,
    read: impl Fn(&[u8]) -> Result<T, String>,
) -> Result<Option<Arc<T>>, SceneError> {
    if path.is_empty() {
        return Ok(None);
    }
    let bytes = super::read(path, &trail, assets)?;
    let bad = |message: String| SceneError::in_file(path, message).named_by(trail).advise(help);
    Ok(Some(Arc::new(read(&bytes).map_err(bad)?)))
}

/// How masks comb the ground, each with the stands it names; none named: all.
pub(super) fn combs(scene: &Scene, assets: &dyn Assets) -> Result<Vec<NamedComb>, SceneError> {
    let mut combs = Vec::new();
    for (index, mask) in scene.masks.iter().enumerate() {
        let trail = |key: &'static str| Trail::default().key("masks").index(index).key(key);
        let direction = picture(&mask.direction, trail("direction"), assets, COLOUR, DirectionImage::from_png)?;
        let grey = |bytes: &[u8]| MaskImage::from_png("picture of messiness", bytes);
        let messiness = picture(&mask.messiness, trail("messiness"), assets, GREY, grey)?;
        if direction.is_some() || messiness.is_some() {
            combs.push((Arc::new(Comb { corner: mask.at, size: mask.size, direction, messiness }), mask.stands.clone()));
        }
    }
    Ok(combs)
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
        let trail = Trail::default().key("masks").index(index);
        let Some(image) = picture(&mask.path, trail.key("path"), assets, GREY, |bytes| MaskImage::from_png("mask", bytes))? else {
            continue;
        };
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
