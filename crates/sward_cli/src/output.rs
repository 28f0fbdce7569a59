//! Files and folders to write: checked before the work by writing and removing something, written whole or not at all.

use std::fs::File;
use std::io::{BufWriter, Write};
use std::path::{Path, PathBuf};

use crate::failure::Failure;

/// The place of one picture: `wanted`, or `name`.png in the current folder.
pub(crate) fn picture(wanted: Option<&Path>, name: &str) -> Result<PathBuf, Failure> {
    let path = wanted.map_or_else(|| PathBuf::from(format!("{name}.png")), Path::to_owned);
    let shown = path.display();
    if path.is_dir() || ends_in_separator(&path) {
        let inside = path.join(format!("{name}.png"));
        return Err(Failure::input(format!("{shown} is a folder, but one picture is one file"), format!("type -o {}", inside.display())));
    }
    if !ends_in(&path, "png") {
        let named = path.with_extension("png");
        return Err(Failure::input(
            format!("pictures are PNG files and clips MP4, and {shown} is named like neither"),
            format!("type -o {} or -o {}", named.display(), path.with_extension("mp4").display()),
        ));
    }
    has_parent(&path)?;
    probe(&partial(&path)).map_err(|error| unwritable(&path, &error, "type -o FILE.png in a folder you may write to"))?;
    Ok(path)
}

/// The place of a clip: `wanted`, or `name`.mp4 in the current folder.
pub(crate) fn clip(wanted: Option<&Path>, name: &str) -> Result<PathBuf, Failure> {
    let path = wanted.map_or_else(|| PathBuf::from(format!("{name}.mp4")), Path::to_owned);
    let shown = path.display();
    if path.is_dir() || ends_in_separator(&path) {
        let inside = path.join(format!("{name}.mp4"));
        return Err(Failure::input(format!("{shown} is a folder, but a clip is one file"), format!("type -o {}", inside.display())));
    }
    if !ends_in(&path, "mp4") {
        let named = path.with_extension("mp4");
        let help = format!("type -o {}, or leave --clip out", named.display());
        return Err(Failure::input(format!("clips are MP4 files, and {shown} is not named like one"), help));
    }
    has_parent(&path)?;
    probe(&partial(&path)).map_err(|error| unwritable(&path, &error, "type -o FILE.mp4 in a folder you may write to"))?;
    Ok(path)
}

/// The place of a plant: `wanted`, or `name`.glb in the current folder.
pub(crate) fn plant(wanted: Option<&Path>, name: &str) -> Result<PathBuf, Failure> {
    let path = wanted.map_or_else(|| PathBuf::from(format!("{name}.glb")), Path::to_owned);
    let shown = path.display();
    if path.is_dir() || ends_in_separator(&path) {
        let inside = path.join(format!("{name}.glb"));
        return Err(Failure::input(format!("{shown} is a folder, but a plant is one file"), format!("type -o {}", inside.display())));
    }
    if !ends_in(&path, "glb") {
        let help = format!("type -o {}", path.with_extension("glb").display());
        return Err(Failure::input(format!("plants are glTF files, and {shown} is not named like one"), help));
    }
    has_parent(&path)?;
    probe(&partial(&path)).map_err(|error| unwritable(&path, &error, "type -o FILE.glb in a folder you may write to"))?;
    Ok(path)
}

/// Writes and removes a file.
fn probe(path: &Path) -> std::io::Result<()> {
    File::create(path).and_then(|_| std::fs::remove_file(path))
}

/// Whether a file is named like one of a kind.
pub(crate) fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension().is_some_and(|extension| extension.eq_ignore_ascii_case(ending))
}

/// A folder to write several files to. It may be missing, the folder around it may not.
pub(crate) fn folder(path: &Path, for_pictures: bool) -> Result<(), Failure> {
    let shown = path.display();
    let help = "type a folder you may write to: -o DIR/";
    if path.is_dir() {
        return probe(&partial(&path.join("probe"))).map_err(|error| unwritable(path, &error, help));
    }
    let like_a_file = ends_in(path, "png");
    if path.exists() || (for_pictures && like_a_file && !ends_in_separator(path)) {
        let named = path.with_extension("");
        let help = format!("type a folder: -o {}{}", named.display(), if named == path { "_files/" } else { "/" });
        return Err(Failure::input(format!("{shown} is a file, but several files are to be written"), help));
    }
    has_parent(path)?;
    let tried = std::fs::create_dir(path).and_then(|()| std::fs::remove_dir(path));
    tried.map_err(|error| unwritable(path, &error, help))
}

fn unwritable(path: &Path, error: &std::io::Error, help: &str) -> Failure {
    Failure::input(format!("cannot write to {}: {error}", path.display()), help)
}

/// The name under which a file is written before it is whole.
fn partial(path: &Path) -> PathBuf {
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    path.with_file_name(format!(".{name}.{}.part", std::process::id()))
}

fn has_parent(path: &Path) -> Result<(), Failure> {
    match path.parent() {
        Some(parent) if !parent.as_os_str().is_empty() && !parent.is_dir() => {
            let shown = parent.display();
            Err(Failure::input(format!("the folder {shown} does not exist"), format!("make it first: mkdir -p {shown}")))
        }
        None => Err(Failure::input(format!("cannot write to `{}`", path.display()), "type -o and a name")),
        _ => Ok(()),
    }
}

fn ends_in_separator(path: &Path) -> bool {
    path.to_string_lossy().ends_with(['/', std::path::MAIN_SEPARATOR])
}

/// Makes a folder that [`folder`] has checked.
pub(crate) fn make_folder(path: &Path) -> Result<(), Failure> {
    if path.is_dir() {
        return Ok(());
    }
    std::fs::create_dir(path).map_err(|error| {
        let shown = path.display();
        Failure::input(format!("cannot make the folder {shown}: {error}"), "type -o and a place that you may write to")
    })
}

/// Removes a file of an earlier run; that there is none is fine.
pub(crate) fn remove(path: &Path) -> Result<(), Failure> {
    match std::fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(cannot_write(path, &error)),
        _ => Ok(()),
    }
}

/// Removes what runs that were killed left half-written in a folder.
pub(crate) fn remove_unfinished(folder: &Path) -> Result<(), Failure> {
    let entries = std::fs::read_dir(folder).map_err(|error| cannot_write(folder, &error))?;
    for entry in entries.flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let ours = name.starts_with(".frame") && name.ends_with(".part");
        if ours {
            remove(&entry.path())?;
        }
    }
    Ok(())
}

/// The frames that lie in a folder, and outputs beside them: `frame_`, digits, and an ending of theirs.
pub(crate) fn frames(folder: &Path) -> Result<Vec<PathBuf>, Failure> {
    let entries = match std::fs::read_dir(folder) {
        Err(error) if error.kind() == std::io::ErrorKind::NotFound => return Ok(Vec::new()),
        entries => entries.map_err(|error| cannot_write(folder, &error))?,
    };
    let is_frame = |path: &PathBuf| {
        let name = path.file_name().unwrap_or_default().to_string_lossy();
        let number = name.strip_prefix("frame_").and_then(|name| name.split_once('.'));
        number.is_some_and(|(number, ending)| {
            let digits = !number.is_empty() && number.bytes().all(|byte| byte.is_ascii_digit());
            digits && (["png", "exr"].contains(&ending) || ending.ends_with(".npy"))
        })
    };
    Ok(entries.flatten().map(|entry| entry.path()).filter(is_frame).collect())
}

/// Removes the frames of a folder, and outputs beside them.
pub(crate) fn remove_frames(folder: &Path) -> Result<(), Failure> {
    frames(folder)?.iter().try_for_each(|frame| remove(frame))
}

/// Refuses a folder where a file is to be written.
pub(crate) fn file(path: &Path) -> Result<(), Failure> {
    if path.is_dir() {
        let shown = path.display();
        return Err(Failure::input(
            format!("{shown} is a folder, but a file is to be written there"),
            "remove it, or type another place: -o …",
        ));
    }
    Ok(())
}

/// A file to write beside a picture: tried now, not after the work.
pub(crate) fn beside(path: &Path) -> Result<(), Failure> {
    file(path)?;
    probe(&partial(path)).map_err(|error| unwritable(path, &error, "type a shorter name: -o FILE.png"))
}

/// Writes a file under another name first: whoever looks sees the old file or the whole new one.
pub(crate) fn write_whole(path: &Path, write: impl FnOnce(&mut BufWriter<File>) -> std::io::Result<()>) -> Result<(), Failure> {
    let partial = partial(path);
    let written = File::create(&partial).and_then(|file| {
        let mut writer = BufWriter::new(file);
        write(&mut writer)?;
        writer.flush()?;
        std::fs::rename(&partial, path)
    });
    written.map_err(|error| {
        // The first error is the one to tell; a leftover that cannot be removed says no more.
        let _ = std::fs::remove_file(&partial);
        cannot_write(path, &error)
    })
}

/// What was checked before the work has changed since: the disk is full, or the folder is gone.
pub(crate) fn cannot_write(path: &Path, error: &std::io::Error) -> Failure {
    Failure::failed(format!("cannot write {}: {error}", path.display())).help("make room there, or type another place: -o …")
}
