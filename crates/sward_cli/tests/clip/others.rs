//! What ffprobe and ffmpeg make of a clip.

use std::process::Command;

use crate::support::Place;

const SIZE: [usize; 2] = [160, 90];
const FRAMES: usize = 12;
/// dB. A frame that is one step of the clip away has less, see the control.
const LEAST: f64 = 30.0;

/// Whether both are installed.
pub(crate) fn are_there() -> bool {
    ["ffprobe", "ffmpeg"].iter().all(|program| Command::new(program).arg("-version").output().is_ok_and(|ran| ran.status.success()))
}

/// Runs one of them in the folder of a test.
fn run(place: &Place, program: &str, arguments: &[&str]) -> Vec<u8> {
    let ran = Command::new(program).current_dir(&place.0).args(arguments).output();
    let ran = ran.unwrap_or_else(|error| panic!("{program}: {error}; Debian: apt-get install ffmpeg"));
    assert!(ran.status.success() && ran.stderr.is_empty(), "{}", String::from_utf8_lossy(&ran.stderr));
    ran.stdout
}

/// The clip in clip.mp4, and the same frames in frames/.
fn clip(name: &str) -> Place {
    let place = Place::with_small(name);
    let common = ["render", "small.ron", "--size", "160x90", "--frames", "0..12", "--fps", "24", "--on", "cpu", "--draw", "cpu", "-o"];
    for to in ["clip.mp4", "frames/"] {
        place.sward(&[&common[..], &[to]].concat()).done();
    }
    place
}

pub(crate) fn ffprobe_finds_what_was_asked_for() {
    let place = clip("clip_ffprobe");
    let json = run(&place, "ffprobe", &["-v", "warning", "-count_frames", "-show_streams", "-show_format", "-of", "json", "clip.mp4"]);
    let found: serde_json::Value = serde_json::from_slice(&json).expect("JSON");
    let stream = &found["streams"][0];
    for (name, wanted) in [
        ("codec_name", "av1"),
        ("profile", "Main"),
        ("pix_fmt", "yuv420p"),
        ("r_frame_rate", "24/1"),
        ("avg_frame_rate", "24/1"),
        ("nb_frames", "12"),
        ("nb_read_frames", "12"),
        ("color_range", "tv"),
        ("color_primaries", "bt709"),
        ("color_space", "bt709"),
        ("color_transfer", "iec61966-2-1"),
    ] {
        assert_eq!(stream[name], wanted, "{name} in {stream:#}");
    }
    assert_eq!([&stream["width"], &stream["height"]], [160, 90]);
    assert_eq!(found["format"]["duration"], "0.500000");
    assert_eq!(found["streams"].as_array().map(Vec::len), Some(1));
}

pub(crate) fn ffmpeg_decodes_the_frames_that_were_drawn() {
    let place = clip("clip_ffmpeg");
    // Nothing here trusts ffmpeg's own choice of a matrix: it is named.
    let scale = "scale=in_color_matrix=bt709:in_range=tv:out_range=pc:flags=accurate_rnd+full_chroma_int+bilinear,format=rgb24";
    let decoded = run(&place, "ffmpeg", &["-v", "error", "-i", "clip.mp4", "-vf", scale, "-f", "rawvideo", "-"]);
    let frame = 3 * SIZE[0] * SIZE[1];
    assert_eq!(decoded.len(), FRAMES * frame);
    let drawn: Vec<Vec<u8>> = (0..FRAMES)
        .map(|index| {
            let path = place.0.join(format!("frames/frame_{index:04}.png"));
            image::open(path).expect("a picture").into_rgb8().into_raw()
        })
        .collect();
    let decoded: Vec<&[u8]> = decoded.chunks_exact(frame).collect();
    for index in 0..FRAMES {
        let likeness = psnr(&drawn[index], decoded[index]);
        println!("frame {index}: {likeness:.1} dB");
        assert!(likeness >= LEAST, "frame {index}: {likeness:.1} dB");
        // Control: six frames away, the picture is another.
        let other = psnr(&drawn[(index + FRAMES / 2) % FRAMES], decoded[index]);
        assert!(other < LEAST, "control, frame {index}: {other:.1} dB");
    }
    // A wrong range would take 14 % of the contrast, or add 16 %.
    let green = |pixels: &[u8]| -> Vec<f64> { pixels.iter().skip(1).step_by(3).map(|value| f64::from(*value)).collect() };
    let (drawn, decoded) = (green(&drawn[0]), green(decoded[0]));
    let washed_out: Vec<f64> = decoded.iter().map(|value| 16.0 + value * 219.0 / 255.0).collect();
    let kept = |values: &[f64]| (contrast(values) / contrast(&drawn) - 1.0).abs() < 0.05;
    assert!(kept(&decoded), "{:.2} became {:.2}", contrast(&drawn), contrast(&decoded));
    assert!(!kept(&washed_out), "control");
}

/// Standard deviation.
fn contrast(values: &[f64]) -> f64 {
    let count = values.len() as f64;
    let mean = values.iter().sum::<f64>() / count;
    (values.iter().map(|value| (value - mean).powi(2)).sum::<f64>() / count).sqrt()
}

/// Peak signal-to-noise ratio, dB.
fn psnr(a: &[u8], b: &[u8]) -> f64 {
    let squares: f64 = a.iter().zip(b).map(|(a, b)| (f64::from(*a) - f64::from(*b)).powi(2)).sum();
    10.0 * (255.0 * 255.0 * a.len() as f64 / squares).log10()
}
