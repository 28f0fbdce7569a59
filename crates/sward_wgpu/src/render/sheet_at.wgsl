// The sheet of a plant as its response has it. Twin: picture/sheet_at.rs, where everything is explained.

// `sheet` holds where its bends alone put it, and is left as it is at the moment of the picture.
fn sheet_at(co: SpringsCoefficients, which: u32, who: Who, root: SheetRoot, sheet: ptr<function, Sheet>) {}
