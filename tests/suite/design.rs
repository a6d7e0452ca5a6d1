//! `centrode design`: two shapes in, files out that other programs can rely on.

use crate::common::{centrode, complaint, tree};
use centrode::geometry::{self, Point};
use serde_json::Value;
use std::f64::consts::TAU;
use std::fs;
use std::path::Path;

/// Poses at which overlap is looked for, off the samples of the file.
const POSES: usize = 64;

/// Overlap that is numerical noise of the comparison, in square modules.
const OVERLAP: f64 = 1e-4;

/// Everything a run writes.
const FILES: [&str; 18] = [
    "design.json",
    "driver.dxf",
    "driver.stl",
    "follower.dxf",
    "follower.stl",
    "laser.svg",
    "pair.3mf",
    "pair.dxf",
    "pair.glb",
    "pair.mtl",
    "pair.obj",
    "pair.step",
    "pair.svg",
    "plate.3mf",
    "report.html",
    "scene.xml",
    "simulation-motor.csv",
    "simulation.csv",
];

struct Made {
    folder: tempfile::TempDir,
    stdout: String,
    record: Value,
}

impl Made {
    /// Runs the command and insists on a sound pair.
    fn new(arguments: &[&str]) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let place = folder.path().to_string_lossy().into_owned();
        let said = centrode(["design", "-o", &place].iter().chain(arguments));
        assert_eq!(said.status.code(), Some(0), "{arguments:?}: {}", complaint(&said));
        assert!(said.stderr.is_empty(), "{}", complaint(&said));
        let text = fs::read_to_string(folder.path().join("design.json")).unwrap();
        let record = serde_json::from_str(&text).unwrap();
        Self { folder, stdout: String::from_utf8(said.stdout).unwrap(), record }
    }

    fn path(&self) -> &Path {
        self.folder.path()
    }

    fn number(&self, path: &str) -> f64 {
        let value = self.record.pointer(path).and_then(Value::as_f64);
        value.unwrap_or_else(|| panic!("{path} is no number"))
    }

    fn numbers(&self, path: &str) -> Vec<f64> {
        self.list(path).iter().map(|v| v.as_f64().unwrap()).collect()
    }

    fn points(&self, path: &str) -> Vec<Point> {
        let coordinates = |v: &Value| Point::new(v[0].as_f64().unwrap(), v[1].as_f64().unwrap());
        self.list(path).iter().map(coordinates).collect()
    }

    fn list(&self, path: &str) -> &[Value] {
        let value = self.record.pointer(path).and_then(Value::as_array);
        value.unwrap_or_else(|| panic!("{path} is no list"))
    }

    /// The promises of every design of ratio `k`.
    fn keeps_its_promises(&self, k: f64) {
        let names: Vec<_> = tree(self.path())
            .iter()
            .map(|p| p.file_name().unwrap().to_string_lossy().into_owned())
            .collect();
        assert_eq!(names, FILES);
        assert_eq!(self.number("/ratio"), k);
        assert_eq!(self.record["units"], "mm");
        assert!(self.record["centrode"].is_string() && self.record["settings"].is_object());
        assert!(["good", "warnings"].map(Value::from).contains(&self.record["meshing"]["verdict"]));
        assert_eq!(self.record["meshing"]["lost_poses"], 0);
        for iou in ["driver", "follower"].map(|g| self.number(&format!("/resemblance/{g}_iou"))) {
            assert!((0.3..=1.0).contains(&iou), "{iou}");
        }
        self.outlines_are_simple();
        self.objective_adds_up();
        self.pitch_curves_roll(k);
        self.motion_is_one_cycle(k);
        self.outlines_never_overlap();
        self.solids_read_back();
    }

    fn outlines_are_simple(&self) {
        for gear in ["driver", "follower"] {
            for part in ["outline", "pitch_curve", "input"] {
                let ring = self.points(&format!("/{gear}/{part}"));
                assert!(ring.first() != ring.last(), "{gear} {part} repeats its last point");
                assert!(geometry::signed_area(&ring) > 0.0, "{gear} {part} turns clockwise");
                assert_eq!(geometry::first_self_crossing(&ring), None, "{gear} {part}");
            }
            if !self.record[gear]["bore"].is_null() {
                let outline = self.points(&format!("/{gear}/outline"));
                let bore = self.points(&format!("/{gear}/bore"));
                assert!(bore.iter().all(|p| geometry::contains(&outline, *p)), "{gear}");
            }
            assert_eq!(self.list(&format!("/{gear}/rotation_center_in_input")).len(), 2);
        }
    }

    fn objective_adds_up(&self) {
        let [total, shape, torque, weight] =
            ["E", "shape", "torque", "weight"].map(|n| self.number(&format!("/objective/{n}")));
        assert!((total - shape - weight * torque).abs() < 1e-9 * total, "E is Eq. 11");
        let [limiting, folding, lost, search] =
            ["limiting_cost", "folding_cost", "lost_cost", "total"]
                .map(|n| self.number(&format!("/objective/{n}")));
        let sum = total + limiting + folding + lost;
        assert!((search - sum).abs() < 1e-9 * search, "the costs add up");
    }

    fn pitch_curves_roll(&self, k: f64) {
        let length =
            |gear: &str| geometry::perimeter(&self.points(&format!("/{gear}/pitch_curve")));
        let teeth = |gear: &str| self.number(&format!("/{gear}/teeth"));
        assert!((length("follower") / length("driver") / k - 1.0).abs() < 1e-3);
        assert_eq!(teeth("follower"), k * teeth("driver"));
        let module = length("driver") / teeth("driver") / (0.5 * TAU);
        assert!((self.number("/module") / module - 1.0).abs() < 1e-3);
    }

    fn motion_is_one_cycle(&self, k: f64) {
        let [driver, follower] =
            ["driver", "follower"].map(|g| self.numbers(&format!("/motion/{g}_angle")));
        assert!(driver.len() >= 1025 && driver.len() == follower.len());
        // The cycle of both gears: the whole turns after which both are back.
        let (turns, follower_turns) = if k >= 1.0 { (k, 1.0) } else { (1.0, 1.0 / k) };
        for (angle, turns) in [(&driver, turns), (&follower, follower_turns)] {
            assert_eq!(angle[0], 0.0);
            assert!(angle.windows(2).all(|w| w[0] < w[1]), "it stands still or turns back");
            assert!((angle[angle.len() - 1] - turns * TAU).abs() < 1e-9);
        }
        // Both pitch curves pass through the pitch point, which lies between the axes.
        let center_distance = self.number("/center_distance");
        let [pitch_driver, pitch_follower] =
            ["driver", "follower"].map(|g| self.points(&format!("/{g}/pitch_curve")));
        for i in (0..driver.len()).step_by(driver.len() / 50) {
            let along = |ring: &[Point], angle: f64| radius_at(ring, angle);
            let sum =
                along(&pitch_driver, -driver[i]) + along(&pitch_follower, 0.5 * TAU + follower[i]);
            assert!((sum / center_distance - 1.0).abs() < 1e-3, "sample {i}: {sum}");
        }
    }

    fn outlines_never_overlap(&self) {
        let [driver, follower] =
            ["driver", "follower"].map(|g| self.points(&format!("/{g}/outline")));
        let angles = self.numbers("/motion/driver_angle");
        let turned = self.numbers("/motion/follower_angle");
        let axis = self.number("/center_distance");
        let whole = geometry::area(&driver);
        for pose in 0..POSES {
            let place = (pose as f64 + 0.37) / POSES as f64 * (angles.len() - 1) as f64;
            let (i, share) = (place as usize, place.fract());
            let between = |v: &[f64]| v[i] + share * (v[i + 1] - v[i]);
            let placed = |ring: &[Point], angle: f64, x: f64| -> Vec<Point> {
                let put = |p: &Point| {
                    let p = geometry::rotate(*p, angle);
                    Point::new(p.x + x, p.y)
                };
                ring.iter().map(put).collect()
            };
            let driver = placed(&driver, between(&angles), 0.0);
            let follower = placed(&follower, -between(&turned), axis);
            let left: f64 = geometry::difference(&driver, &[follower])
                .iter()
                .flatten()
                .map(|ring| geometry::signed_area(ring))
                .sum();
            let overlap = (whole - left) / self.number("/module").powi(2);
            assert!(overlap < OVERLAP, "pose {pose}: {overlap} square modules");
        }
    }

    fn solids_read_back(&self) {
        let thickness = self.number("/thickness");
        for gear in ["driver", "follower"] {
            let mut file = fs::File::open(self.path().join(format!("{gear}.stl"))).unwrap();
            let mesh = stl_io::read_stl(&mut file).unwrap();
            let corner = |i: usize| mesh.vertices[i].0.map(f64::from);
            let volume: f64 = mesh
                .faces
                .iter()
                .map(|f| {
                    let [a, b, c] = f.vertices.map(corner);
                    (a[0] * (b[1] * c[2] - b[2] * c[1])
                        + a[1] * (b[2] * c[0] - b[0] * c[2])
                        + a[2] * (b[0] * c[1] - b[1] * c[0]))
                        / 6.0
                })
                .sum();
            let bore = match self.record[gear]["bore"].is_null() {
                true => 0.0,
                false => geometry::area(&self.points(&format!("/{gear}/bore"))),
            };
            let area = geometry::area(&self.points(&format!("/{gear}/outline"))) - bore;
            assert!((volume / (area * thickness) - 1.0).abs() < 1e-4, "{gear}: {volume}");
        }
        let bytes = fs::read(self.path().join("pair.glb")).unwrap();
        let scene = gltf::Gltf::from_slice(&bytes).unwrap();
        assert_eq!(scene.meshes().count(), 2);
        assert_eq!(scene.materials().count(), 2);
        assert_eq!(scene.animations().count(), 1);
    }
}

/// Distance from the origin to a star-shaped ring in a direction, radians.
fn radius_at(ring: &[Point], angle: f64) -> f64 {
    let (sin, cos) = angle.sin_cos();
    let across = |p: &Point| cos * p.y - sin * p.x;
    let along = |p: &Point| cos * p.x + sin * p.y;
    let edges = ring.iter().zip(ring.iter().cycle().skip(1));
    edges
        .filter(|(a, b)| (across(a) > 0.0) != (across(b) > 0.0))
        .map(|(a, b)| along(a) + across(a) / (across(a) - across(b)) * (along(b) - along(a)))
        .fold(0.0, f64::max)
}

/// Turned by one k-th of a turn, the ring covers itself to 1e-6 of its size.
fn is_symmetric(ring: &[Point], folds: usize) {
    assert_eq!(ring.len() % folds, 0);
    let step = ring.len() / folds;
    let size = ring.iter().map(|p| p.coords.norm()).fold(0.0, f64::max);
    for (i, p) in ring.iter().enumerate() {
        let image = geometry::rotate(*p, TAU / folds as f64);
        assert!((image - ring[(i + step) % ring.len()]).norm() < 1e-6 * size, "point {i}");
    }
}

/// Turned by one k-th of a turn, the boundary covers itself within `tolerance` (mm). Where arcs are
/// broken into chords may differ from one k-th to the next.
fn covers_itself(ring: &[Point], folds: usize, tolerance: f64) {
    for p in ring.iter().step_by(7) {
        let image = geometry::rotate(*p, TAU / folds as f64);
        let edges = ring.iter().zip(ring.iter().cycle().skip(1));
        let away = edges.map(|(a, b)| distance(image, *a, *b)).fold(f64::INFINITY, f64::min);
        assert!(away < tolerance, "{away} mm away from {image}");
    }
}

/// From a point to a segment.
fn distance(p: Point, a: Point, b: Point) -> f64 {
    let (along, to) = (b - a, p - a);
    let share = (to.dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
    (to - share * along).norm()
}

#[test]
fn heart_drives_dove() {
    let made = Made::new(&["heart", "dove"]);
    made.keeps_its_promises(1.0);
    let told = made.stdout.lines().last().unwrap_or_default();
    assert!(told.contains("report.html"), "the summary does not say where the page is");
    let page = fs::read_to_string(made.path().join("report.html")).unwrap();
    assert!(!page.contains("src=\"http") && !page.contains("@import"), "the page needs a network");
}

#[test]
fn ellipse_drives_ellipse() {
    Made::new(&["ellipse", "ellipse"]).keeps_its_promises(1.0);
}

#[test]
fn drop_drives_heart() {
    Made::new(&["drop", "heart"]).keeps_its_promises(1.0);
}

#[test]
fn bell_drives_candy_at_two() {
    let made = Made::new(&["bell", "candy", "-k", "2"]);
    made.keeps_its_promises(2.0);
    // Two chord tolerances: each k-th is within one of the true outline.
    let tolerance = 2.0 * made.number("/settings/chord-tolerance") * made.number("/module");
    covers_itself(&made.points("/follower/outline"), 2, tolerance);
    is_symmetric(&made.points("/follower/pitch_curve"), 2);
}

#[test]
fn leaf_drives_flower_at_three() {
    let made = Made::new(&["leaf", "flower", "-k", "3"]);
    made.keeps_its_promises(3.0);
    // Two chord tolerances: each k-th is within one of the true outline.
    let tolerance = 2.0 * made.number("/settings/chord-tolerance") * made.number("/module");
    covers_itself(&made.points("/follower/outline"), 3, tolerance);
    is_symmetric(&made.points("/follower/pitch_curve"), 3);
}

#[test]
fn candy_drives_bell_at_a_half() {
    let made = Made::new(&["candy", "bell", "-k", "1/2"]);
    made.keeps_its_promises(0.5);
    is_symmetric(&made.points("/driver/pitch_curve"), 2);
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let read = || {
        let made = Made::new(&["heart", "drop", "--search", "paper"]);
        FILES.map(|name| fs::read(made.path().join(name)).unwrap())
    };
    for ((name, first), second) in FILES.iter().zip(read()).zip(read()) {
        assert!(first == second, "{name} differs between two runs");
    }
}

#[test]
fn json_is_all_there_is_on_standard_output() {
    let made = Made::new(&["egg", "drop", "--search", "paper", "--json"]);
    let told: Value = serde_json::from_str(&made.stdout).unwrap();
    assert_eq!(told["objective"]["E"], made.record["objective"]["E"]);
    assert_eq!(told["verdict"], made.record["meshing"]["verdict"]);
    let files: Vec<_> = told["files"].as_array().unwrap().iter().collect();
    assert_eq!(files.len(), FILES.len());
    assert!(files.iter().all(|f| Path::new(f.as_str().unwrap()).is_file()));
}

#[test]
fn lengths_in_inches_studs_and_overall() {
    let common = ["egg", "drop", "--search", "paper"];
    let made = |more: [&str; 2]| Made::new(&[common.as_slice(), &more].concat());
    assert!((made(["--center-distance", "3in"]).number("/center_distance") - 76.2).abs() < 1e-9);
    assert!(
        (made(["--center-distance", "lego:10"]).number("/center_distance") - 80.0).abs() < 1e-9
    );
    let sized = made(["--size", "120mm"]);
    let mut all = sized.points("/driver/outline");
    let axis = sized.number("/center_distance");
    let follower = sized.points("/follower/outline");
    all.extend(follower.iter().map(|p| Point::new(p.x + axis, p.y)));
    let (low, high) = geometry::bounds(&all);
    let extent = (high - low).max();
    assert!((115.0..120.01).contains(&extent), "{extent}");
}

#[test]
fn bores_by_name() {
    let made = |bore| Made::new(&["egg", "drop", "--search", "paper", "--bore", bore]);
    assert!(made("none").record["driver"]["bore"].is_null());
    let cross = made("lego").points("/driver/bore");
    let (low, high) = geometry::bounds(&cross);
    assert!((4.8..5.1).contains(&(high.x - low.x)), "{}", high.x - low.x);
    let round = geometry::area(&made("4mm").points("/follower/bore"));
    assert!((round / (0.25 * 0.5 * TAU * 16.0) - 1.0).abs() < 0.01, "{round}");
}

#[test]
fn the_search_of_the_paper_and_its_teeth() {
    let made = Made::new(&["ellipse", "drop", "--search", "paper"]);
    made.keeps_its_promises(1.0);
    assert_eq!(made.record["settings"]["search"], "paper");
    // Waves promise no sound contact, but with --force they are made and told from a sound pair.
    let folder = tempfile::tempdir().unwrap();
    let place = folder.path().to_string_lossy().into_owned();
    let options = ["--teeth-style", "wave", "--search", "paper", "--force"];
    let said = centrode(["design", "ellipse", "drop", "-o", &place].iter().chain(&options));
    let text = fs::read_to_string(folder.path().join("design.json")).unwrap();
    let record: Value = serde_json::from_str(&text).unwrap();
    let sound = record["meshing"]["verdict"] != "unsound";
    assert_eq!(said.status.code(), Some(if sound { 0 } else { 1 }), "{}", complaint(&said));
    assert_eq!(record["settings"]["teeth-style"], "wave");
}
