//! What an author sees after each kind of mistake: the place, what happened, and what to type instead.

use sward::scene::Scene;

/// Text, line, column, start of the message, part of the help.
type Mistake = (&'static str, u32, u32, &'static str, &'static str);

const SYNTAX: &[Mistake] = &[
    ("(stands: [])", 1, 12, "`version` is missing in `Scene`", "version: 1"),
    ("(version: 2, novelty: 3)", 1, 11, "this file needs a newer sward: it has format version 2", "version 1"),
    ("(version: 1,\n wnd: [])", 2, 2, "`Scene` has no field `wnd`", "did you mean `wind`?"),
    ("(version: 1,\n stands: [(species: meadow)])", 2, 21, "`meadow` is not known as `Species`", "did you mean `Meadow`?"),
    ("(version: 1,\n stands: [(name: \"a\")])", 2, 21, "`species` is missing in `Stand`", "species"),
    ("(version: 1, seed: 3,\n seed: 4)", 2, 2, "`seed` is given twice", "keep one"),
    ("(version: 1, seed: 1.5)", 1, 21, "expected", ""),
    ("(version: 1, seed: -1)", 1, 21, "integer is out of bounds", "negative"),
    ("(version: 1, camera: (eye: [0, 1, 2]))", 1, 28, "expected opening `(`", "round brackets"),
    ("(version: 1, wind: [Natural])", 1, 28, "expected opening `(`", "every default"),
    ("(version: 1, camera: (eye: (0, 1)))", 1, 33, "expected an array of length 3", ""),
    ("(version: 1, stands: (species: Lawn))", 1, 22, "expected opening `[`", "square brackets"),
    ("(version: 1", 1, 12, "expected comma", "missing"),
    ("(version: 1) x", 1, 14, "non-whitespace trailing", "remove"),
    ("", 1, 1, "", ""),
];

const RANGES: &[Mistake] = &[
    ("(version: 0)", 1, 11, "`version` is 0, allowed 1 to 1", ""),
    ("(version: 1, wind: [\n Uniform(velocity: (900, 0))])", 2, 27, "`velocity` is 900 m/s, allowed -60 to 60", ""),
    ("(version: 1, light: (\n fog: NaN,\n))", 2, 7, "`fog` is NaN 1/m, allowed 0 to 1", ""),
    ("(version: 1, light: (\n fog: -inf))", 2, 7, "`fog` is -inf 1/m", ""),
];

const STANDS: &[Mistake] = &[
    ("(version: 1, stands: [\n (species: Lawn,\n  cells: 100)])", 3, 10, "`cells` is 100, allowed are multiples of 8", "96 or 104"),
    (
        "(version: 1, stands: [(species: Lawn), // name: \"x\"\n (species: Meadow, name: \"lawn\")])",
        2,
        26,
        "two stands are called `lawn`",
        "another",
    ),
    ("(version: 1, stands: [(species: Lawn,\n height: (2, 1))])", 2, 10, "`height` runs from 2 down to 1", "(1, 2)"),
    ("(version: 1, stands: [(species: Reed,\n height: (4, 6))])", 2, 10, "`height` is 6 m, allowed 0.01 to 5", "Tree"),
    ("(version: 1, stands: [(species: Reed,\n places: [(at: (0, 0))])])", 2, 10, "`places` are for shrubs", "mask"),
    ("(version: 1, stands: [(species: Shrub,\n response: Springs())])", 2, 12, "plants in layers sway as a whole", "Harmonic"),
    ("(version: 1, stands: [(species: Tree,\n representation: Blade())])", 2, 18, "plants that sway as a whole are meshes", "Layers"),
    (
        "(version: 1, stands: [(species: Tree, response: Harmonic(\n cells: 100))])",
        2,
        9,
        "`cells` is 100, allowed are powers of two",
        "64 or 128",
    ),
    ("(version: 1, stands: [(species: Tree, response: Harmonic(\n cells: 8))])", 2, 9, "`cells` is 8 cells, allowed 16 to 512", ""),
    (
        "(version: 1, stands: [(species: Tree, representation: Layers(\n bands: (0.7, 0.3)))])",
        2,
        9,
        "`bands` end at 0.7 and then at 0.3",
        "(0.3, 0.7)",
    ),
    ("(version: 1, stands: [(species: Tree, representation: Layers(mesh: File(\n path: \"\")))])", 2, 8, "`path` is empty", "glb"),
    (
        "(version: 1, stands: [(species: Tree, representation: Layers(mesh: Grown(\n triangles: 7)))])",
        2,
        13,
        "`triangles` is 7, allowed 2000 to 64000000",
        "",
    ),
    (
        "(version: 1, stands: [(species: Lawn, response: Continuum(\n frequency: 1,\n kappa: 3))])",
        2,
        13,
        "both `frequency` and `kappa` are given",
        "keep",
    ),
    (
        "(version: 1, stands: [(species: Lawn, response: Continuum(lambda_theta: 0.5,\n damping: 3))])",
        2,
        11,
        "both `damping` and `lambda_theta`",
        "keep",
    ),
    (
        "(version: 1, stands: [(species: Meadow, response: Continuum(frequency: 0,\n damping: 1))])",
        2,
        11,
        "`damping` 1 at 0.00 Hz needs lambda_theta 0.000, allowed 0.01 to 0.95",
        "raise",
    ),
];

const BLADES: &[Mistake] = &[
    (
        "(version: 1, stands: [(species: Meadow, representation: Blade(\n pieces: (4, 7, 2)))])",
        2,
        10,
        "`pieces` rise with distance: 4, 7, 2",
        "(7, 4, 2)",
    ),
    (
        "(version: 1, stands: [(species: Meadow, representation: Blade(\n piece_distances: (30, 10)))])",
        2,
        19,
        "`piece_distances` run from 30 down to 10",
        "(10, 30)",
    ),
    ("(version: 1, stands: [(species: Meadow, representation: Blade(\n thinning: (0, 0, 0)))])", 2, 12, "all of `thinning` is 0", "0.15"),
    ("(version: 1, stands: [(species: Meadow, representation: Blade(\n blades: 65))])", 2, 10, "`blades` is 65, allowed 1 to 64", ""),
    ("(version: 1, stands: [(species: Meadow, representation: Blade(\n sheen: 1))])", 2, 2, "`Blade` has no field `sheen`", "silhouette"),
    ("(version: 1, stands: [(species: Meadow, representation: Sheet(\n rows: 1))])", 2, 8, "`rows` is 1, allowed 2 to 9", ""),
    ("(version: 1, stands: [(species: Meadow, representation: Sheet(\n points: 10))])", 2, 10, "`points` is 10, allowed 2 to 9", ""),
    ("(version: 1, stands: [(species: Meadow, representation: Sheet(\n cards: 2))])", 2, 2, "`Sheet` has no field `cards`", "columns"),
    (
        "(version: 1, stands: [(species: Meadow, response: Springs(rows: 4), representation: Sheet(\n rows: 3))])",
        2,
        8,
        "`rows` of the sheet is 3, and the response's sheets have 4",
        "write `rows` in `Springs(…)` only",
    ),
    ("(version: 1, stands: [(species: Meadow,\n representation: Blades()))])", 2, 18, "`Blades` is not known", "did you mean `Blade`?"),
];

const BODIES: &[Mistake] = &[
    ("(version: 1, terrain: Image(scale: 2,\n path: \"\"))", 2, 8, "`path` is empty", "PNG"),
    (
        "(version: 1, interactors: [(shape: Truck, path: Keyframes(keys: [\n (time: 1, at: (0, 0)),\n (time: 1, at: (1, 0))]))])",
        3,
        9,
        "`time` is 1 s, but the key before it is at 1 s",
        "increasing",
    ),
    ("(version: 1, interactors: [(shape: Truck,\n from: 3, until: 2)])", 2, 18, "`until` is 2 s", "later"),
    (
        "(version: 1, interactors: [(shape: Polygon(\n points: [(0, 0), (2, 0), (0.5, 0.5), (0, 2)]))])",
        2,
        10,
        "`points` is not a convex polygon",
        "Compound",
    ),
    ("(version: 1, interactors: [(shape: Polygon(\n points: [(0, 0), (2, 0)]))])", 2, 10, "`points` has 2, allowed 3 to 16", ""),
    (
        "(version: 1, interactors: [(shape: Compound(parts: [(shape: Sphere()),\n (shape: Truck)]))])",
        2,
        10,
        "a part is neither",
        "Ellipsoid",
    ),
    (
        "(version: 1, interactors: [(shape: Truck, name: \"pickup\")],\n camera: (follow: \"pikup\"))",
        2,
        19,
        "no interactor is called `pikup`",
        "did you mean `pickup`?",
    ),
    ("(version: 1, camera: (eye: (1, 2, 3),\n target: (1, 2, 3)))", 2, 10, "`target` is where the eye is", "move"),
];

const AIR: &[Mistake] = &[
    ("(version: 1, wind: [Fluid(\n cells: 48)])", 2, 9, "`cells` is 48, allowed are powers of two", "32 or 64"),
    ("(version: 1, wind: [Fluid(\n cells: 1024)])", 2, 9, "`cells` is 1024, allowed 16 to 512", ""),
    ("(version: 1, wind: [Fluid(\n side: 2)])", 2, 8, "`side` is 2 m, allowed 4 to 512", ""),
    ("(version: 1, wind: [Fluid(\n fade: 0)])", 2, 8, "`fade` is 0 s, allowed 0.05 to 60", ""),
    ("(version: 1, wind: [Fluid(\n viscosity: NaN)])", 2, 13, "`viscosity` is NaN m²/s, allowed 0 to 10", ""),
    ("(version: 1, wind: [Fluid(\n gust: [])])", 2, 2, "`Fluid` has no field `gust`", "did you mean `gusts`?"),
    (
        "(version: 1, wind: [Fluid(gusts: [(\n from: Weast)])])",
        2,
        8,
        "`Weast` is not known as `GustFrom`",
        "known: West, East, North, South, Place",
    ),
    ("(version: 1, wind: [Fluid(gusts: [(from: Place(\n))])])", 2, 1, "`at` is missing in `Place`", "add `at: …`"),
    ("(version: 1, wind: [Fluid(gusts: [(\n strength: 1000)])])", 2, 12, "`strength` is 1000 m/s per s, allowed -100 to 100", ""),
    (
        "(version: 1, wind: [Fluid(side: 10, gusts: [(), (\n radius: 6)])])",
        2,
        10,
        "`radius` is 6 m, but the square is 10 m wide",
        "at most 5",
    ),
    ("(version: 1, wind: [Fluid(), Natural(), Fluid(),\n Fluid()])", 2, 2, "this is one `Fluid` more than 2", "remove one"),
    (
        "(version: 1, wind: [Fluid(gusts: [(), (), (), (), (), (), (), (), (), (), (), (), (), (), (), (),\n (radius: 2)])])",
        2,
        2,
        "this is one gust more than 16",
        "remove one",
    ),
];

#[test]
fn mistakes_are_explained_where_they_are() {
    let mut wrong = Vec::new();
    for &(text, line, column, message, help) in [SYNTAX, RANGES, STANDS, BLADES, BODIES, AIR].concat().iter() {
        let error = Scene::parse(text, "test.ron").expect_err(text);
        let advice = error.help.as_deref().unwrap_or("");
        let right = (error.line, error.column) == (line, column) && error.message.starts_with(message) && advice.contains(help);
        if !right {
            wrong.push(format!("{text}\n  → {error}"));
        }
        assert_eq!((error.file.as_str(), error.text.as_str()), ("test.ron", text));
        let shown = text.get(error.span());
        assert!(shown.is_some_and(|shown| !shown.contains('\n')), "{text}");
    }
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}
