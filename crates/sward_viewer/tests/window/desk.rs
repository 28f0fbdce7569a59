//! A display, a window on it, and hands.

use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use libtest_mimic::Failed;
use serde_json::Value;

/// Longest that anything may take.
const PATIENCE: Duration = Duration::from_secs(240);
/// Size of the window.
pub(crate) const SIZE: [u32; 2] = [1040, 660];

/// A window on a display of its own. Both end with it.
pub(crate) struct Desk {
    display: String,
    xvfb: Child,
    window: Child,
    /// Files of this window.
    pub(crate) folder: PathBuf,
}

/// What is missing for the tests.
pub(crate) fn missing() -> Option<String> {
    let there =
        |program: &str| std::env::split_paths(&std::env::var_os("PATH").unwrap_or_default()).any(|folder| folder.join(program).is_file());
    let absent = ["Xvfb", "xdotool", "import"].into_iter().find(|program| !there(program));
    absent.map(|program| format!("{program} is not installed")).or_else(|| sward_wgpu::gpu::Gpu::new().err().map(|error| error.to_string()))
}

/// Where screenshots go.
pub(crate) fn screenshots() -> PathBuf {
    std::env::var_os("SWARD_SCREENSHOTS").map_or_else(|| Path::new(env!("CARGO_TARGET_TMPDIR")).join("screenshots"), PathBuf::from)
}

fn failed(what: impl Into<String>) -> Failed {
    Failed::from(what.into())
}

impl Desk {
    /// Opens a window with these arguments, and waits for its scene.
    pub(crate) fn open(name: &str, arguments: &[&str], environment: &[(&str, &str)]) -> Result<Self, Failed> {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("window {name}"));
        let _ = std::fs::remove_dir_all(&folder);
        std::fs::create_dir_all(&folder)?;
        let (xvfb, display) = display(&folder)?;
        let log = std::fs::File::create(folder.join("log"))?;
        let mut command = Command::new(env!("CARGO_BIN_EXE_sward_viewer"));
        command.args(arguments).arg("--size").arg(format!("{}x{}", SIZE[0], SIZE[1])).arg("--status").arg(folder.join("status.json"));
        command.env("DISPLAY", &display).env_remove("WAYLAND_DISPLAY").env("XDG_DATA_HOME", folder.join("data"));
        command.envs(environment.iter().copied()).current_dir(&folder).stdout(Stdio::null()).stderr(log);
        let window = command.spawn()?;
        let mut desk = Self { display, xvfb, window, folder };
        desk.wait("a scene", |now| now["scene"] != "" && now["pictures"].as_u64() > Some(3))?;
        let found = desk.tool(&["search", "--name", "^sward$"])?;
        let window = found.lines().next().ok_or_else(|| failed("the window has no title"))?.to_owned();
        desk.tool(&["windowfocus", &window])?;
        desk.pictures(2)?;
        Ok(desk)
    }

    /// What the window shows now.
    pub(crate) fn now(&self) -> Option<Value> {
        serde_json::from_slice(&std::fs::read(self.folder.join("status.json")).ok()?).ok()
    }

    /// Waits until what the window shows is as wanted, and returns it.
    pub(crate) fn wait(&mut self, what: &str, wanted: impl Fn(&Value) -> bool) -> Result<Value, Failed> {
        let begun = Instant::now();
        let mut last = None;
        while begun.elapsed() < PATIENCE {
            if let Some(ended) = self.window.try_wait()? {
                return Err(failed(format!("the window closed ({ended}): {}", self.log())));
            }
            if let Some(now) = self.now() {
                if wanted(&now) {
                    return Ok(now);
                }
                last = Some(now);
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let last = last.map(|mut now| {
            now["marks"] = Value::Null;
            now
        });
        Err(failed(format!("waited in vain for {what}; the window shows {last:?} and says: {}", self.log())))
    }

    /// Waits for so many more pictures.
    pub(crate) fn pictures(&mut self, count: u64) -> Result<Value, Failed> {
        let before = self.now().and_then(|now| now["pictures"].as_u64()).unwrap_or(0);
        self.wait("pictures", |now| now["pictures"].as_u64() >= Some(before + count))
    }

    /// Waits for so many more steps.
    pub(crate) fn steps(&mut self, count: u64) -> Result<Value, Failed> {
        let before = self.now().and_then(|now| now["step"].as_u64()).unwrap_or(0);
        self.wait("steps", |now| now["step"].as_u64() >= Some(before + count))
    }

    /// What the window has written to its standard error.
    pub(crate) fn log(&self) -> String {
        std::fs::read_to_string(self.folder.join("log")).unwrap_or_default()
    }

    fn tool(&self, arguments: &[&str]) -> Result<String, Failed> {
        let output = Command::new("xdotool").args(arguments).env("DISPLAY", &self.display).output()?;
        if !output.status.success() {
            return Err(failed(format!("xdotool {arguments:?}: {}", String::from_utf8_lossy(&output.stderr))));
        }
        Ok(String::from_utf8_lossy(&output.stdout).into_owned())
    }

    /// The middle of something in the window.
    pub(crate) fn place(&mut self, mark: &str) -> Result<[i32; 2], Failed> {
        let now = self.wait(mark, |now| now["marks"][mark].is_array())?;
        let part = |index: usize| now["marks"][mark][index].as_f64().unwrap_or(0.0);
        Ok([(part(0) + 0.5 * part(2)) as i32, (part(1) + 0.5 * part(3)) as i32])
    }

    /// Moves the mouse.
    pub(crate) fn point(&mut self, [x, y]: [i32; 2]) -> Result<(), Failed> {
        self.tool(&["mousemove", &x.to_string(), &y.to_string()])?;
        self.pictures(2).map(|_| ())
    }

    /// Presses or lets go of the left button.
    pub(crate) fn button(&mut self, down: bool) -> Result<(), Failed> {
        self.tool(&[if down { "mousedown" } else { "mouseup" }, "1"])?;
        self.pictures(2).map(|_| ())
    }

    /// Clicks a place.
    pub(crate) fn click_at(&mut self, at: [i32; 2]) -> Result<(), Failed> {
        self.point(at)?;
        self.button(true)?;
        self.button(false)
    }

    /// Clicks on something.
    pub(crate) fn click(&mut self, mark: &str) -> Result<(), Failed> {
        let at = self.place(mark)?;
        self.click_at(at)
    }

    /// Drags from a place, by way of others.
    pub(crate) fn drag(&mut self, places: &[[i32; 2]]) -> Result<(), Failed> {
        for (index, place) in places.iter().enumerate() {
            self.point(*place)?;
            if index == 0 {
                self.button(true)?;
            }
        }
        self.button(false)
    }

    /// Presses and lets go of a key.
    pub(crate) fn key(&mut self, key: &str) -> Result<(), Failed> {
        self.tool(&["key", key])?;
        self.pictures(2).map(|_| ())
    }

    /// Holds a key down, or lets go of it.
    pub(crate) fn hold(&mut self, key: &str, down: bool) -> Result<(), Failed> {
        self.tool(&[if down { "keydown" } else { "keyup" }, key]).map(|_| ())
    }

    /// Saves what the whole display shows.
    pub(crate) fn shot(&mut self, name: &str) -> Result<image::RgbImage, Failed> {
        self.pictures(1)?;
        let folder = screenshots();
        std::fs::create_dir_all(&folder)?;
        let path = folder.join(format!("{name}.png"));
        let taken = Command::new("import").args(["-window", "root"]).arg(&path).env("DISPLAY", &self.display).status()?;
        if !taken.success() {
            return Err(failed("import took no picture"));
        }
        Ok(image::open(&path).map_err(|error| failed(error.to_string()))?.into_rgb8())
    }

    /// Memory that the window holds, bytes.
    pub(crate) fn memory(&self) -> Option<u64> {
        let about = std::fs::read_to_string(format!("/proc/{}/status", self.window.id())).ok()?;
        let line = about.lines().find(|line| line.starts_with("VmRSS:"))?;
        line.split_whitespace().nth(1)?.parse::<u64>().ok().map(|kilobytes| kilobytes << 10)
    }
}

impl Drop for Desk {
    fn drop(&mut self) {
        for child in [&mut self.window, &mut self.xvfb] {
            let _ = child.kill();
            let _ = child.wait();
        }
    }
}

/// A display with a number that nobody has yet.
fn display(folder: &Path) -> Result<(Child, String), Failed> {
    let numbers = folder.join("display");
    let out = std::fs::File::create(&numbers)?;
    let mut xvfb = Command::new("Xvfb");
    xvfb.args(["-displayfd", "1", "-screen", "0", &format!("{}x{}x24", SIZE[0], SIZE[1]), "-nolisten", "tcp"]);
    let mut child = xvfb.stdout(out).stderr(Stdio::null()).spawn()?;
    let begun = Instant::now();
    while begun.elapsed() < Duration::from_secs(20) {
        let said = std::fs::read_to_string(&numbers)?;
        if said.ends_with('\n') {
            return Ok((child, format!(":{}", said.trim())));
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill()?;
    Err(failed("Xvfb did not start"))
}
