// Sources as they are read in a patch, of a host in which none is tiled.

fn wind_octave(index: u32, tiled: bool) -> WindOctave {
    return wind.octaves[index];
}

fn wind_fluid(index: u32, tiled: bool) -> WindFluid {
    return wind.fluids[index];
}
