//! Leaf or wood: what the scene says, else what a material's name says, else whether it has holes.

use super::{Kind, SpecimenError};
use crate::figure::json::Material;

/// Materials named by the scene; others are judged by name and alpha.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Rule {
    /// Names of materials of leaves.
    pub leaves: Vec<String>,
    /// Names of materials of wood.
    pub wood: Vec<String>,
}

/// How words for leaves and other soft parts begin or end.
const LEAF_WORDS: [&str; 31] = [
    "leaf",
    "leav",
    "foliage",
    "needle",
    "frond",
    "petal",
    "flower",
    "blossom",
    "grass",
    "blade",
    "fern",
    "ivy",
    "moss",
    "reed",
    "ribbon",
    "blatt",
    "blätter",
    "blaetter",
    "laub",
    "nadel",
    "blüte",
    "bluete",
    "feuille",
    "feuillage",
    "fleur",
    "hoja",
    "folha",
    "foglia",
    "foglie",
    "лист",
    "葉",
];
/// How words for wood begin or end.
const WOOD_WORDS: [&str; 21] = [
    "bark", "wood", "trunk", "branch", "stem", "twig", "bough", "stalk", "rinde", "borke", "holz", "stamm", "zweig", "écorce", "ecorce",
    "tronc", "bois", "corteza", "madera", "кора", "樹皮",
];

/// The words of a name, in lower case: `OakBark_02` has `oak` and `bark`.
fn words(name: &str) -> Vec<String> {
    let (mut words, mut word, mut small) = (Vec::new(), String::new(), false);
    for letter in name.chars() {
        if !letter.is_alphabetic() || letter.is_uppercase() && small {
            words.extend((!word.is_empty()).then(|| std::mem::take(&mut word)));
        }
        small = letter.is_lowercase();
        if letter.is_alphabetic() {
            word.extend(letter.to_lowercase());
        }
    }
    words.extend((!word.is_empty()).then_some(word));
    words
}

fn by_name(name: &str) -> Option<Kind> {
    let words = words(name);
    let says = |list: &[&str]| words.iter().any(|word| list.iter().any(|known| word.starts_with(known) || word.ends_with(known)));
    match (says(&LEAF_WORDS), says(&WOOD_WORDS)) {
        (true, _) => Some(Kind::Leaf),
        (false, true) => Some(Kind::Wood),
        (false, false) => None,
    }
}

impl Rule {
    fn said(&self, name: &str) -> Option<Kind> {
        let within = |list: &[String]| list.iter().any(|known| known == name);
        if within(&self.leaves) { Some(Kind::Leaf) } else { within(&self.wood).then_some(Kind::Wood) }
    }

    fn checked(&self, materials: &[Material]) -> Result<(), SpecimenError> {
        if let Some(name) = self.leaves.iter().find(|name| self.wood.contains(name)) {
            return Err(SpecimenError::Both(name.clone()));
        }
        let mut asked = self.leaves.iter().chain(&self.wood);
        let Some(asked) = asked.find(|name| !materials.iter().any(|material| material.name == **name)) else { return Ok(()) };
        let names: Vec<&str> = materials.iter().map(|material| material.name.as_str()).filter(|name| !name.is_empty()).collect();
        let known = match names.is_empty() {
            true => "the file names none: leave `leaves` and `wood` out".to_owned(),
            false => format!("known: {}", names.join(", ")),
        };
        Err(SpecimenError::Material { asked: asked.clone(), known })
    }

    /// What each material is, and what has none.
    pub(super) fn kinds(&self, materials: &[Material]) -> Result<(Vec<Kind>, Kind), SpecimenError> {
        self.checked(materials)?;
        let told = |material: &Material| {
            let holes = ["MASK", "BLEND"].contains(&material.alpha_mode.as_str());
            self.said(&material.name).or_else(|| by_name(&material.name)).or(holes.then_some(Kind::Leaf))
        };
        let told: Vec<Option<Kind>> = materials.iter().map(told).collect();
        // A plant of one unnamed material is all leaf; beside leaves, what nothing is known of is wood.
        let other = if told.contains(&Some(Kind::Leaf)) { Kind::Wood } else { Kind::Leaf };
        Ok((told.into_iter().map(|kind| kind.unwrap_or(other)).collect(), other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_say_what_is_leaf() {
        for name in
            ["leaves", "Leaf_01", "oakLeaves", "TREE-FOLIAGE", "pine needles", "branchLeaf", "Birkenblatt", "Feuilles", "листья", "Blätter"]
        {
            assert_eq!(by_name(name), Some(Kind::Leaf), "{name}");
        }
        for name in ["bark", "OakBark2", "Trunk", "tree_stem", "Holz.001", "écorce", "WOOD"] {
            assert_eq!(by_name(name), Some(Kind::Wood), "{name}");
        }
        for name in ["", "Material.001", "A set.001", "green", "colormap"] {
            assert_eq!(by_name(name), None, "{name}");
        }
    }
}
