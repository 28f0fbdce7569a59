//! Meshes of plants, read or grown: each once, however many stands have it.

use std::path::Path;
use std::sync::Arc;

use super::{Assets, read};
use crate::scene::{Form, PlantFile, PlantMesh, SceneError, Trail};
use crate::specimen::grow::{self, Grow};
use crate::specimen::{Order, Rule, Size, Specimen, SpecimenError};

/// The meshes read so far.
#[derive(Default)]
pub(super) struct Specimens(Vec<(PlantMesh, Arc<Specimen>)>);

impl Specimens {
    /// The mesh that stand number `index` names.
    pub(super) fn of(&mut self, mesh: &PlantMesh, index: usize, assets: &dyn Assets) -> Result<Arc<Specimen>, SceneError> {
        if let Some((_, known)) = self.0.iter().find(|(other, _)| other == mesh) {
            return Ok(Arc::clone(known));
        }
        let trail = Trail::default().key("stands").index(index).key("representation").key("mesh");
        let made = match mesh {
            PlantMesh::File(file) => from_file(file, &trail, assets)?,
            PlantMesh::Grown(grown) => {
                let form = match grown.form {
                    Form::Bush => grow::Form::Bush,
                    Form::Tree => grow::Form::Tree,
                    Form::WaterPlant => grow::Form::WaterPlant,
                };
                let grow = Grow { seed: grown.seed, triangles: grown.triangles, ..Grow::new(form) };
                let made = grow.specimen(&mut |share| assets.progress("growing plants", share));
                made.map_err(|error| SceneError::in_file("", error.to_string()).named_by(trail))?
            }
        };
        let made = Arc::new(made);
        self.0.push((mesh.clone(), Arc::clone(&made)));
        Ok(made)
    }
}

fn from_file(file: &PlantFile, trail: &Trail, assets: &dyn Assets) -> Result<Specimen, SceneError> {
    let bytes = read(&file.path, &trail.clone().key("path"), assets)?;
    let beside = |name: &str| {
        let folder = Path::new(&file.path).parent().unwrap_or(Path::new(""));
        assets.read(&folder.join(name).to_string_lossy())
    };
    // Stands say how high their plants are: units of files do not matter.
    let order = Order { rule: Rule { leaves: file.leaves.clone(), wood: file.wood.clone() }, size: Size::Height(1.0) };
    let made = Specimen::stored(&bytes, &beside, &order, assets.store(), &mut |share| assets.progress("preparing plants", share));
    match made {
        Ok((specimen, found)) => {
            found.trouble.iter().for_each(|trouble| assets.note(&format!("{trouble}; the plant was prepared anew")));
            Ok(specimen)
        }
        Err(error) => {
            let field = match &error {
                SpecimenError::Material { asked, .. } | SpecimenError::Both(asked) if file.wood.contains(asked) => "wood",
                SpecimenError::Material { .. } | SpecimenError::Both(_) => "leaves",
                _ => "path",
            };
            let text = error.to_string();
            // Most errors end with what to do.
            let (what, help) = text.split_once("; ").unwrap_or((&text, "export it again; a glTF validator says more"));
            Err(SceneError::in_file(&file.path, what.to_owned()).named_by(trail.clone().key(field)).advise(help))
        }
    }
}
