//! Bad input is answered by one clear line and exit code 2, and leaves nothing behind.

use crate::common::{centrode, complaint, tree};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::time::{Duration, Instant};

/// Longest time any refusal may take, also in an unoptimised build on a busy machine.
const PATIENCE: Duration = Duration::from_secs(60);

/// A folder for drawings and one, not there yet, for output.
struct Bench {
    top: tempfile::TempDir,
}

impl Bench {
    fn new() -> Self {
        Self { top: tempfile::tempdir().unwrap() }
    }

    fn output(&self) -> PathBuf {
        self.top.path().join("out")
    }

    fn file(&self, name: &str, content: impl AsRef<[u8]>) -> String {
        let path = self.top.path().join(name);
        fs::write(&path, content).unwrap();
        path.to_string_lossy().into_owned()
    }

    /// Whether the drawing is refused, as driver and as follower, with the words.
    fn refuses(&self, drawing: &str, words: &[&str]) {
        for shapes in [[drawing, "heart"], ["heart", drawing]] {
            let text = self.refuses_options(&shapes, words);
            assert!(text.contains(drawing), "the drawing is not named: {text}");
        }
    }

    /// Whether these arguments are refused: once with no output folder, once with a full one.
    fn refuses_options(&self, arguments: &[&str], words: &[&str]) -> String {
        let output = self.output();
        let run = || {
            let place = ["-o".as_ref(), output.as_os_str()];
            let start = Instant::now();
            let said =
                centrode(["design"].iter().chain(arguments).map(std::ffi::OsStr::new).chain(place));
            assert!(start.elapsed() < PATIENCE, "{arguments:?} took {:?}", start.elapsed());
            said
        };
        one_clear_line(&run(), words);
        assert!(!output.exists(), "{arguments:?} made the output folder");
        fs::create_dir(&output).unwrap();
        fs::write(output.join("design.json"), "older").unwrap();
        let text = one_clear_line(&run(), words);
        assert_eq!(tree(&output), [output.join("design.json")]);
        assert_eq!(fs::read_to_string(output.join("design.json")).unwrap(), "older");
        fs::remove_dir_all(&output).unwrap();
        text
    }
}

/// The one line on standard error of a run that refused its input.
fn one_clear_line(said: &Output, words: &[&str]) -> String {
    let text = complaint(said);
    assert_eq!(said.status.code(), Some(2), "{text}");
    assert!(said.stdout.is_empty(), "{}", String::from_utf8_lossy(&said.stdout));
    assert_eq!(text.trim_end().lines().count(), 1, "{text}");
    assert!(text.starts_with("error: ") && !text.contains("panicked"), "{text}");
    for word in words {
        assert!(text.contains(word), "`{word}` is missing: {text}");
    }
    text
}

fn svg(body: &str) -> String {
    format!(
        "<svg xmlns='http://www.w3.org/2000/svg' xmlns:xlink='http://www.w3.org/1999/xlink' \
         viewBox='0 0 100 100'>{body}</svg>"
    )
}

fn picture(width: u32, height: u32, color: impl Fn(u32, u32) -> u8) -> Vec<u8> {
    let mut bytes = std::io::Cursor::new(Vec::new());
    image::GrayImage::from_fn(width, height, |x, y| image::Luma([color(x, y)]))
        .write_to(&mut bytes, image::ImageFormat::Png)
        .unwrap();
    bytes.into_inner()
}

#[test]
fn files_that_are_missing_or_no_drawings() {
    let bench = Bench::new();
    bench.refuses("no/such/file.svg", &["no such file", "check the path"]);
    bench.refuses("haert", &["did you mean `heart`"]);
    bench.refuses(&bench.file("a.png", "this is no image"), &["; "]);
    bench.refuses(&bench.file("a.docx", "neither is this"), &["use SVG, DXF"]);
    bench.refuses(&bench.file("cut.png", &picture(40, 40, |_, _| 0)[..60]), &["; "]);
    bench.refuses(&bench.file("empty.png", ""), &["empty"]);
    let folder = bench.top.path().to_string_lossy().into_owned();
    bench.refuses(&folder, &["folder"]);
}

#[test]
fn svg_drawings_without_a_shape() {
    let bench = Bench::new();
    for (name, body, word) in [
        ("empty.svg", "", "draws nothing"),
        ("text.svg", "<text x='9' y='50'>gear</text>", "only text"),
        ("open.svg", "<path d='M10 10H90V90' fill='none' stroke='black'/>", "open by"),
        ("line.svg", "<path d='M10 10H90Z' fill='none' stroke='black'/>", "; "),
        ("flat.svg", "<path d='M10 10L90 90L50 50Z'/>", "; "),
        ("nan.svg", "<path d='M10 NaN L90 90 L50 10Z'/>", "cannot be read; correct"),
    ] {
        bench.refuses(&bench.file(name, svg(body)), &[word]);
    }
    bench.refuses(&bench.file("xml.svg", "<svg"), &["XML"]);
    let flat = "<svg xmlns='http://www.w3.org/2000/svg' width='0' height='-3'><rect width='2' height='2'/></svg>";
    bench.refuses(&bench.file("size.svg", flat), &["viewBox", "; remove width and height"]);
}

#[test]
fn outlines_that_are_no_outlines() {
    let bench = Bench::new();
    let bow_tie = "0,0\n2,2\n2,0\n0,2\n";
    bench.refuses(&bench.file("crossed.csv", bow_tie), &["crosses itself at", "redraw"]);
    bench.refuses(&bench.file("two.csv", "0,0\n1,1\n"), &["2 distinct points"]);
    bench.refuses(&bench.file("two.json", "[[0,0],[1,1]]"), &["2 distinct points"]);
    bench.refuses(&bench.file("nan.csv", "0,0\n1,NaN\n2,2\n"), &["line 2"]);
    bench.refuses(&bench.file("nan.json", "[[0,0],[1,NaN],[2,2]]"), &["line 1"]);
    bench.refuses(&bench.file("names.csv", "id,e,n\n1,0,0\n2,4,0\n3,4,3\n"), &["line 1", "; call"]);
    bench.refuses(&bench.file("far.csv", "0,0\n1e300,0\n0,1e300\n"), &["scale it down"]);
    bench.refuses(&bench.file("flat.csv", "0,0\n1,1\n2,2\n3,3\n"), &["no area"]);
}

#[test]
fn images_without_a_silhouette() {
    let bench = Bench::new();
    bench.refuses(&bench.file("dot.png", picture(1, 1, |_, _| 0)), &["; "]);
    bench.refuses(&bench.file("white.png", picture(200, 100, |_, _| 255)), &["; "]);
    bench.refuses(&bench.file("black.png", picture(200, 100, |_, _| 0)), &["; "]);
}

/// A real one: a bilevel PNG of 20,000 x 20,000 with a disc in it, a few kilobytes long.
#[test]
fn images_too_large_to_decode() {
    let bench = Bench::new();
    let mut bytes = std::io::Cursor::new(Vec::new());
    let side = 20_000_u32;
    let inside = |x: u32, y: u32| x.abs_diff(side / 2) + y.abs_diff(side / 2) < side / 4;
    let large = image::GrayImage::from_fn(side, side, |x, y| {
        image::Luma([if inside(x, y) { 0 } else { 255 }])
    });
    large.write_to(&mut bytes, image::ImageFormat::Png).unwrap();
    bench.refuses(&bench.file("large.png", bytes.get_ref()), &["20000", "; "]);
}

#[test]
fn use_elements_that_multiply() {
    let bench = Bench::new();
    let mut bomb = "<defs><rect id='a0' width='1' height='1'/>".to_owned();
    for level in 1..=20 {
        let copy = format!("<use xlink:href='#a{}'/>", level - 1);
        bomb += &format!("<g id='a{level}'>{copy}{copy}</g>");
    }
    bomb += "</defs><use xlink:href='#a20'/>";
    bench.refuses(&bench.file("bomb.svg", svg(&bomb)), &["`use`"]);
    let circle = "<g id='a'><use href='#b'/></g><g id='b'><use href='#a'/></g>";
    bench.refuses(&bench.file("circle.svg", svg(circle)), &["refers back"]);
    let deep =
        format!("{}<rect width='9' height='9'/>{}", "<g>".repeat(50_000), "</g>".repeat(50_000));
    bench.refuses(&bench.file("deep.svg", svg(&deep)), &["; "]);
    let mut entities = "<!DOCTYPE svg [<!ENTITY e0 'ha'>".to_owned();
    for level in 1..=20 {
        entities += &format!("<!ENTITY e{level} '&e{0};&e{0};'>", level - 1);
    }
    let laughs = entities + "]>" + &svg("<text>&e20;</text>");
    bench.refuses(&bench.file("laughs.svg", laughs), &["; "]);
}

/// A server and a file that a drawing refers to: neither may be touched.
#[test]
fn external_references_are_never_fetched() {
    let bench = Bench::new();
    let server = std::net::TcpListener::bind("127.0.0.1:0").unwrap();
    server.set_nonblocking(true).unwrap();
    let address = server.local_addr().unwrap();
    let other = bench.file("other.svg", svg("<circle id='c' cx='50' cy='50' r='40'/>"));
    let photo =
        bench.file("other.png", picture(40, 40, |x, y| if x.max(y) < 20 { 0 } else { 255 }));
    for (name, body) in [
        ("use.svg", format!("<use xlink:href='http://{address}/a.svg#c'/>")),
        ("image.svg", format!("<image width='90' height='90' href='http://{address}/a.png'/>")),
        ("file.svg", format!("<use href='{other}#c'/>")),
        ("uri.svg", format!("<image width='90' height='90' href='file://{photo}'/>")),
        ("near.svg", "<image width='90' height='90' href='other.png'/>".to_owned()),
    ] {
        bench.refuses(&bench.file(name, svg(&body)), &["never fetched"]);
    }
    let style = format!("<style>@import url('http://{address}/a.css');</style>");
    bench.refuses(&bench.file("style.svg", svg(&style)), &["draws nothing"]);
    let entity = format!("<!DOCTYPE svg [<!ENTITY e SYSTEM 'file://{other}'>]>");
    bench.refuses(&bench.file("entity.svg", entity + &svg("<g>&e;</g>")), &["; "]);
    let waiting = server.accept().map_err(|e| e.kind());
    assert_eq!(waiting.err(), Some(std::io::ErrorKind::WouldBlock), "something was fetched");
}

#[test]
fn sizes_that_are_zero_negative_or_no_lengths() {
    let bench = Bench::new();
    for option in ["--center-distance", "--size", "--thickness", "--module", "--bore"] {
        for value in ["0", "-5mm", "nan", "inf", "wide", "1e300m"] {
            bench.refuses_options(&["heart", "dove", option, value], &[]);
        }
    }
    for option in ["--clearance", "--backlash", "--root-clearance"] {
        bench.refuses_options(&["heart", "dove", option, "-0.1mm"], &[option, "0 or more"]);
    }
    bench.refuses_options(&["heart", "dove", "--center-distance", "lego:0"], &["lego:10"]);
    bench.refuses_options(&["heart", "dove", "--size", "-5mm"], &["--size", "such as 80mm"]);
    for [option, value] in [
        ["--teeth", "0"],
        ["--teeth", "-3"],
        ["--teeth", "4000000000"],
        ["--chord-tolerance", "0"],
        ["--addendum", "-1"],
        ["--pressure-angle", "90"],
        ["--max-lean", "-10"],
        ["--max-torque", "0.5"],
        ["--balance", "2"],
        ["--torque-weight", "-1"],
        ["--smoothing", "7"],
        ["--threshold", "999"],
        ["--search", "luck"],
    ] {
        bench.refuses_options(&["heart", "dove", option, value], &[]);
    }
    // More than the gear has room for.
    bench.refuses_options(&["heart", "dove", "--bore", "70mm", "--search", "paper"], &["; "]);
}

#[test]
fn outfits_that_cannot_be_made() {
    let bench = Bench::new();
    for (options, words) in [
        (vec!["--bore", "oval:4"], vec!["oval:4", "hex:6"]),
        (vec!["--bore", "d:5x1x1"], vec!["d:5x4.5"]),
        (vec!["--bore", "keyway:3"], vec!["DIN 6885", "keyway:3x2x1"]),
        (vec!["--bore", "d:5x2"], vec!["across the flat", "half the diameter"]),
        (vec!["--fit", "snug"], vec!["tight, slide, loose"]),
        (vec!["--fit", "9mm"], vec!["the fit", "give 0 to"]),
        (vec!["--chamfer", "5mm"], vec!["the chamfer", "up to 4.00 mm"]),
        (vec!["--chamfer", "-1mm"], vec!["--chamfer", "0 or more"]),
        (vec!["--hub-height", "0"], vec!["--hub-height"]),
        (vec!["--hub-height", "2mm", "--set-screw", "2.5mm"], vec!["set screw", "0.40 mm"]),
        (vec!["--screws", "0"], vec!["number of screws"]),
        (vec!["--lightening", "1"], vec!["lightening holes", "auto"]),
        (vec!["--lightening", "many"], vec!["auto"]),
        (vec!["--emboss=\u{7}"], vec!["no font", "\\u{7}"]),
        (vec!["--emboss=  "], vec!["no letters"]),
        (vec!["--base", "table"], vec!["pins"]),
        (vec!["--base", "lego", "--center-distance", "83mm"], vec!["lego:10"]),
        (vec!["--base", "pins", "--base-thickness", "0"], vec!["--base-thickness"]),
    ] {
        let arguments: Vec<&str> = ["heart", "dove"].into_iter().chain(options).collect();
        bench.refuses_options(&arguments, &words);
    }
    // Known only once the gears are there.
    let quick = ["heart", "dove", "--search", "paper", "--no-simulate", "--teeth", "24"];
    for (options, words) in [
        (vec!["--center-distance", "10mm", "--bore", "lego"], vec!["the bore leaves", "bore"]),
        (vec!["--bore", "hex:70"], vec!["the largest hex bore that fits"]),
        (vec!["--hub-diameter", "90mm"], vec!["no room for a hub", "the largest that fits"]),
    ] {
        let arguments: Vec<&str> = quick.into_iter().chain(options).collect();
        bench.refuses_options(&arguments, &words);
    }
}

#[test]
fn ratios_that_are_no_ratios() {
    let bench = Bench::new();
    for ratio in ["0", "7/3", "-1", "1/0", "2.5", "nan", "", "1000000"] {
        bench.refuses_options(&["heart", "dove", "-k", ratio], &["whole number"]);
    }
}

#[test]
fn arguments_that_are_missing_or_unknown() {
    for arguments in [vec!["design", "heart"], vec!["design", "heart", "dove"], vec!["turn"]] {
        one_clear_line(&centrode(&arguments), &["--help"]);
    }
    let bench = Bench::new();
    bench.refuses_options(&["heart", "dove", "--teht", "12"], &["--teht", "--teeth"]);
}

/// Permissions do not bind the superuser; a file in the way does.
#[test]
fn a_folder_that_cannot_be_made() {
    let bench = Bench::new();
    let plain = bench.file("plain", "kept");
    let in_the_way = ["plain is a file, not a folder; choose another folder with -o"];
    for (place, words) in [
        (plain.clone(), &in_the_way[..]),
        (format!("{plain}/out"), &in_the_way[..]),
        ("/proc/none/out".to_owned(), &["cannot write", "choose a folder"][..]),
    ] {
        let said = centrode(["design", "heart", "dove", "--search", "paper", "-o", &place]);
        one_clear_line(&said, words);
    }
    let sheet = centrode(["shapes", "--sheet", &format!("{plain}/all.svg")]);
    one_clear_line(&sheet, &["not a folder; name another place with --sheet"]);
    assert_eq!(fs::read_to_string(&plain).unwrap(), "kept");
}

#[test]
fn drawings_of_the_user_are_not_overwritten() {
    let bench = Bench::new();
    let drawing = centrode::outline::library::svg("ellipse").unwrap();
    let shape = bench.file("pair.svg", drawing);
    let folder = bench.top.path().to_string_lossy().into_owned();
    let list = bench.file("gallery.csv", "ellipse egg\n");
    let before = tree(bench.top.path());
    let mate = ["mate", &shape, "--teeth", "24", "--no-simulate", "--export", "svg"];
    let words = ["pair.svg is a drawing that this run reads", "; choose another folder with -o"];
    one_clear_line(&centrode(mate.iter().chain(&["-o", &folder])), &words);
    let gallery = centrode(["gallery", "--pairs", &list, "--no-teeth", "-o", &folder]);
    one_clear_line(&gallery, &["gallery.csv is a file that this run reads", "; choose another"]);
    let check = centrode(["check", &shape, &shape, "--save-scene", &shape]);
    one_clear_line(&check, &["pair.svg is a file that", "; name another place with --save-scene"]);
    assert_eq!(tree(bench.top.path()), before);
    assert_eq!(fs::read_to_string(&shape).unwrap(), drawing);
}

#[test]
fn what_cannot_be_saved_is_told_before_the_run() {
    let bench = Bench::new();
    let scene = bench.file("scene.toml", "driver = 'heart'\nfollower = 'drop'\n");
    let save = bench.top.path().join("saved.toml").to_string_lossy().into_owned();
    let output = bench.output().to_string_lossy().into_owned();
    let run = centrode(["run", &scene, "-o", &output, "--save-scene", &save]);
    one_clear_line(&run, &["`centrode run` has no scene of its own; "]);
    let merge = centrode(["gallery", "merge", &output, "-o", &output, "--save-scene", &save]);
    one_clear_line(&merge, &["`centrode gallery merge` has no scene; leave out --save-scene"]);
    let below = format!("{scene}/saved.toml");
    let shapes = centrode(["shapes", "--save-scene", &below]);
    one_clear_line(&shapes, &["scene.toml is a file, not a folder; ", "--save-scene"]);
    assert_eq!(tree(bench.top.path()), [Path::new(&scene)]);
}

#[test]
fn options_of_files_have_ranges_and_do_not_contradict() {
    let bench = Bench::new();
    for (option, value, words) in [
        ("--kerf", "6mm", ["--kerf", "; give 0mm to 5mm"]),
        ("--kerf", "1e300", ["--kerf", "; give 0mm to 5mm"]),
        ("--curve-tolerance", "5mm", ["--curve-tolerance", "; give 0.00001mm to 0.05mm"]),
        ("--curve-tolerance", "1e-300", ["--curve-tolerance", "; give 0.00001mm to 0.05mm"]),
    ] {
        bench.refuses_options(&["heart", "dove", "--export", "json", option, value], &words);
    }
    let both = ["heart", "dove", "--material", "steel", "--density", "1000"];
    bench.refuses_options(&both, &["--material", "cannot be used with"]);
    let output = bench.output().to_string_lossy().into_owned();
    let bent = centrode(["train", "no-such-pair", "--bend", "10", "-o", &output]);
    one_clear_line(&bent, &["--bend", "--layout zigzag"]);
}

#[test]
fn no_option_is_echoed_at_length() {
    let bench = Bench::new();
    let [number, name] = ["9", "x"].map(|c| c.repeat(4000));
    for arguments in [
        vec!["heart", "dove", "--search", "paper", "--driver-axis", "1e308,0"],
        vec!["heart", "dove", "--bore", &number],
        vec!["heart", &name],
    ] {
        let said = bench.refuses_options(&arguments, &["; "]);
        assert!(said.len() < 900, "{} bytes: {said}", said.len());
    }
}

#[test]
fn nothing_is_coloured_where_no_color_is_wanted() {
    for color in [("NO_COLOR", "1"), ("TERM", "dumb")] {
        let said = Command::new(env!("CARGO_BIN_EXE_centrode"))
            .args(["design", "heart", "dove", "--kerf", "wide", "-o", "out"])
            .env(color.0, color.1)
            .output()
            .unwrap();
        let text = one_clear_line(&said, &["--kerf"]);
        assert!(!text.contains('\u{1b}'), "{text}");
    }
}

/// A small file system of its own, taken down when dropped; none where mounting is not allowed.
struct Mount(tempfile::TempDir);

impl Mount {
    fn new(options: &str) -> Option<Self> {
        let place = tempfile::tempdir().unwrap();
        let said = Command::new("mount")
            .args(["-t", "tmpfs", "-o", options, "tmpfs"])
            .arg(place.path())
            .output();
        match said {
            Ok(said) if said.status.success() => Some(Self(place)),
            Ok(said) => {
                eprintln!("skipped: no file system may be mounted here: {}", complaint(&said));
                None
            }
            Err(error) => {
                eprintln!("skipped: there is no mount command: {error}");
                None
            }
        }
    }

    fn path(&self) -> &Path {
        self.0.path()
    }
}

impl Drop for Mount {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.path()).status();
    }
}

#[test]
fn a_disk_that_is_full() {
    let Some(disk) = Mount::new("size=64k") else { return };
    let place = disk.path().join("deep/out");
    let run = || {
        centrode(["design", "heart", "dove", "--search", "paper", "-o", &place.to_string_lossy()])
    };
    one_clear_line(&run(), &["no space left", "free some"]);
    assert!(tree(disk.path()).is_empty(), "left behind: {:?}", tree(disk.path()));
    fs::create_dir_all(&place).unwrap();
    fs::write(place.join("pair.glb"), "older").unwrap();
    one_clear_line(&run(), &["no space left", "free some"]);
    assert_eq!(tree(&place), [place.join("pair.glb")]);
    assert_eq!(fs::read_to_string(place.join("pair.glb")).unwrap(), "older");
}

#[test]
fn a_disk_that_is_read_only() {
    let Some(disk) = Mount::new("size=64k,ro") else { return };
    let place = disk.path().join("out");
    let said =
        centrode(["design", "heart", "dove", "--search", "paper", "-o", &place.to_string_lossy()]);
    one_clear_line(&said, &["cannot write", "choose a folder"]);
}

#[test]
fn choices_that_cannot_be_fixed() {
    let bench = Bench::new();
    for (more, word) in [
        (&["--driver-axis", "900,900"][..], "(900.0000, 900.0000)"),
        (&["--follower-axis", "-1,-1"], "does not lie inside"),
        (&["--driver-axis", "nan,1"], "12.5,-3"),
        (&["--orientation", "up"], "degrees"),
        (&["--symmetric"], "one shape"),
        (&["--symmetric", "--orientation", "10"], "cannot be used with"),
        (&["--threads", "0"], "1..=1024"),
    ] {
        bench.refuses_options(&[&["heart", "dove"], more].concat(), &[word]);
    }
}
