// Sources as they are read in a patch, of a host that has another `tile_wind: WindBlock` for the one that is tiled.

fn wind_octave(index: u32, tiled: bool) -> WindOctave {
    if tiled {
        return tile_wind.octaves[index];
    }
    return wind.octaves[index];
}

fn wind_fluid(index: u32, tiled: bool) -> WindFluid {
    if tiled {
        return tile_wind.fluids[index];
    }
    return wind.fluids[index];
}
