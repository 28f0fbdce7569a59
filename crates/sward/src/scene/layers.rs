//! Settings of the representation that draws meshes in layers, and where its meshes come from.
//!
//! Chen & Johan 2015, §3.2, §3.5 and §3.6; methods §5.

use super::parameters::{choices, parameters, parameters_with_overrides};

choices! {
    /// What a plant's mesh is.
    pub enum PlantMesh {
        /// A glTF file.
        File(PlantFile),
        /// Grown by code.
        Grown(Grown),
    }
}

parameters! {
    /// A plant from a glTF file, +y up, its root at the origin. What is leaf, and sways, and what is wood, and does not, is told by the names of its materials,
    /// or by their transparency.
    pub struct PlantFile {
        /// Path of a `.glb` or `.gltf` file, relative to the scene file's folder or to the folder above that.
        path: String = String::new(), "", required;
        /// Names of materials that are leaves, where the file's own do not tell.
        leaves: Vec<String> = Vec::new(), "";
        /// Names of materials that are wood.
        wood: Vec<String> = Vec::new(), "";
    }
}

choices! {
    /// How a plant grows.
    pub enum Form {
        /// A round shrub with leaves from the ground up.
        Bush,
        /// A trunk and a crown.
        Tree,
        /// Long soft leaves and feathery stems.
        WaterPlant,
    }
}

parameters! {
    /// A plant grown by code: the same numbers always give the same plant. `sward grow` writes it as a file.
    pub struct Grown {
        /// How it grows.
        form: Form = Form::Bush, "";
        /// Which of all such plants.
        seed: u32 = 1, "";
        /// About how many triangles it has.
        triangles: u32 = 20000, "" in 2000..=64000000;
    }
}

choices! {
    /// When layers farther off show what the first one did.
    pub enum Follow {
        /// As long ago as the wind takes to get there, from a record of the last 1.5 s.
        Record,
        /// The same from where motion was on its way, looked up in the present: the paper's way to save memory.
        LookUp,
        /// At the same time.
        AtOnce,
    }
}

parameters_with_overrides! {
    /// How plants are cut into layers by their distance from the eye, and how far these move.
    pub struct Layers, LayersOverrides {
        /// The mesh. Without it one of the species, grown by code.
        mesh: PlantMesh = PlantMesh::Grown(Grown::default()), "";
        /// Layers of the nearest part of a plant.
        near: u32 = 3, "" in 1..=8;
        /// Of the part behind it.
        mid: u32 = 1, "" in 1..=4;
        /// Of the farthest part.
        far: u32 = 1, "" in 1..=4;
        /// Shares of a plant's depth at which the nearest part ends, and the one behind it.
        bands: [f32; 2] = [0.34, 0.67], "" in 0.0..=1.0;
        /// Turn of the view of a plant after which it is cut anew.
        turn: f32 = 0.0873, "rad" in 0.01..=0.5;
        /// Time in which newly cut layers take over.
        fade: f32 = 0.2, "s" in 0.0..=2.0;
        /// How far leaves move sideways, up and down, and shrink where they move to or from the eye: metres for each metre of their way in 1/60 s.
        scale: [f32; 3] = [2.0, 1.2, 0.8], "" in 0.0..=100.0;
        /// How much stiffer a plant is near its root: a power of the height above it; 0 moves everything alike.
        rigidity: f32 = 1.0, "" in 0.0..=10.0;
        /// Share of its motion that the farthest layer loses.
        loss: f32 = 0.3, "" in 0.0..=1.0;
        /// When layers farther off move.
        follow: Follow = Follow::Record, "";
        /// Distance from the camera beyond which plants are left out.
        distance: f32 = 160.0, "m" in 1.0..=2000.0;
    }
    extra {}
}

parameters! {
    /// A plant at a place of its own.
    pub struct Place {
        /// Where.
        at: [f64; 2] = [0.0, 0.0], "m" in -1000000.0..=1000000.0, required;
        /// Its turn.
        yaw: f32 = 0.0, "rad" in -7.0..=7.0;
        /// Its height. Without it a chance one of the stand's.
        height: Option<f32> = None, "m" in 0.01..=50.0;
    }
}
