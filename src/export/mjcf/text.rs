//! A scene in the words of MJCF.

use super::{Body, Scene};
use crate::geometry::Point;
use crate::policy;
use std::fmt::Write;

/// Length of a gear's pointer over its pitch radius there.
pub(super) const POINTER_LENGTH: f64 = 0.75;
/// Decimals of a vertex: a hundred-thousandth of half a module.
const DECIMALS: usize = 5;
/// Flags for collisions between neighbours; gears this far apart in a long train share one.
const COLLISION_BITS: usize = 30;
/// Colours of the driver and of the gears after it, in turn.
const COLORS: [&str; 3] = ["0.29 0.58 0.86 1", "0.16 0.27 0.52 1", "0.35 0.65 0.55 1"];

pub(super) fn text(scene: &Scene<'_>) -> String {
    let mut out = String::new();
    // Writing into a string cannot fail.
    let _ = head(scene, &mut out);
    let _ = assets(scene, &mut out);
    let _ = world(scene, &mut out);
    let _ = machinery(scene, &mut out);
    prefixed(&out, &prefix(scene))
}

/// What stands before every name, so that the scene can be included beside others: the gears' names and a slash.
fn prefix(scene: &Scene<'_>) -> String {
    let names: Vec<String> = scene.bodies.iter().map(|b| escaped(b)).collect();
    // A long train is told by its ends.
    match &names[..] {
        [first, .., last] if names.len() > 3 => format!("{first}-to-{last}/"),
        _ => format!("{}/", names.join("-")),
    }
}

/// The text with `prefix` before every name and every reference to one.
fn prefixed(text: &str, prefix: &str) -> String {
    const NAMES: [&str; 8] =
        ["name", "class", "childclass", "material", "texture", "mesh", "joint", "actuator"];
    let mut out = String::with_capacity(text.len() + text.len() / 8);
    for line in text.split_inclusive('\n') {
        let mut rest = line;
        // Each value between quotes goes on as it is, with the prefix where its attribute is one of names.
        while let Some((before, after)) = rest.split_once("=\"") {
            out.push_str(before);
            out.push_str("=\"");
            if NAMES.iter().any(|n| before.strip_suffix(n).is_some_and(|b| b.ends_with(' '))) {
                out.push_str(prefix);
            }
            let (value, next) = after.split_once('"').unwrap_or((after, ""));
            out.push_str(value);
            out.push('"');
            rest = next;
        }
        out.push_str(rest);
    }
    out
}

fn head(scene: &Scene<'_>, out: &mut String) -> std::fmt::Result {
    let options = scene.options;
    let last = scene.bodies.len() - 1;
    let teeth: Vec<String> = scene.bodies.iter().map(|b| b.placed.gear.teeth.to_string()).collect();
    let names: Vec<String> = scene.bodies.iter().map(|b| escaped(b)).collect();
    let friction = if options.friction > 0.0 { 3 } else { 1 };
    writeln!(out, "<?xml version=\"1.0\" encoding=\"utf-8\"?>")?;
    writeln!(
        out,
        "<!--
  Gears that turn one another by their teeth: nothing but contact couples them.
  Open in MuJoCo 3.2 or newer (simulate scene.xml): it turns by itself.

  Time s, angle rad, torque N mm. Lengths: one unit is mm_per_unit millimetres (a module is
  {module} units); so a force of one unit is 1 / mm_per_unit N. Axes along z, counter-clockwise positive;
  all angles are 0 in the first pose of the design, whose motion stands in design.json, not here.
  The first gear is the driver and turns counter-clockwise at the speed of the design; ctrl[0] adds
  to that speed (rad/s). A constant torque holds the last gear back; ctrl[1] adds to it (N mm).
  Sensors: the angle of each gear; driver_torque, what the drive gives.
  All names begin with those of the gears, so that the scene can be included in a world of one's own.
  custom: load (N mm), rpm, friction, kappa (inertia of the last gear x speed^2 x greatest |psi''| over the
  load), teeth of each gear, mm_per_unit, steps_per_tooth.
  Each body's mass sits off its axis: mass on a hinge would make contacts infinitely hard. Its
  moment about the hinge is the gear's own, or a flywheel's for a kappa of at least {kappa}.
-->
<mujoco model=\"{model}\">
  <compiler angle=\"radian\" autolimits=\"true\"/>
  <option timestep=\"{timestep:e}\" gravity=\"0 0 0\" integrator=\"implicitfast\" solver=\"Newton\" \
         cone=\"elliptic\" iterations=\"100\" tolerance=\"{tolerance:e}\"/>
  <custom>",
        module = policy::MJCF_MODULE,
        kappa = policy::LEAST_KAPPA,
        model = names.join(" "),
        timestep = scene.timestep,
        tolerance = policy::MJCF_TOLERANCE * scene.speed * scene.speed,
    )?;
    for (name, data) in [
        ("load", options.load.to_string()),
        ("rpm", options.rpm.to_string()),
        ("friction", options.friction.to_string()),
        ("kappa", scene.kappa.to_string()),
        ("teeth", teeth.join(" ")),
        ("mm_per_unit", scene.mm_per_unit.to_string()),
        ("steps_per_tooth", options.steps_per_tooth.to_string()),
    ] {
        writeln!(out, "    <numeric name=\"{name}\" data=\"{data}\"/>")?;
    }
    writeln!(out, "  </custom>")?;
    let (center, extent) = extent(scene);
    writeln!(
        out,
        "  <statistic center=\"{:.3} {:.3} 0\" extent=\"{extent:.3}\" meansize=\"{:.3}\"/>
  <visual>
    <global azimuth=\"90\" elevation=\"-65\" offwidth=\"1280\" offheight=\"960\"/>
    <headlight ambient=\"0.35 0.35 0.35\" diffuse=\"0.35 0.35 0.35\" specular=\"0.1 0.1 0.1\"/>
    <map shadowclip=\"3\"/>
    <quality shadowsize=\"4096\"/>
  </visual>
  <default>
   <default class=\"gears\">
    <joint type=\"hinge\" axis=\"0 0 1\"/>
    <geom solref=\"{:e} 2\" solimp=\"{i} {i} 0.001 0.5 2\" margin=\"0\" condim=\"{friction}\" friction=\"{} 0 0\"/>",
        center.x,
        center.y,
        policy::MJCF_MODULE,
        2.0 * scene.timestep,
        options.friction,
        i = policy::MJCF_IMPEDANCE,
    )?;
    for i in 0..=last {
        // A gear matches those that it drives by its own flag. Flags repeat only far along a train.
        let flag = |k: usize| 1_u64 << (k % COLLISION_BITS);
        let own = if scene.meshes.iter().any(|m| m[0] == i) { flag(i) } else { 0 };
        let before = scene.meshes.iter().filter(|m| m[1] == i).fold(0, |all, m| all | flag(m[0]));
        writeln!(
            out,
            "    <default class=\"gear{i}\"><geom material=\"gear{i}\" contype=\"{own}\" conaffinity=\"{before}\"/></default>"
        )?;
    }
    writeln!(
        out,
        "    <default class=\"picture\"><geom contype=\"0\" conaffinity=\"0\"/></default>\n   </default>\n  </default>"
    )
}

fn assets(scene: &Scene<'_>, out: &mut String) -> std::fmt::Result {
    writeln!(
        out,
        "  <asset>
    <texture type=\"skybox\" builtin=\"gradient\" rgb1=\"0.93 0.95 0.97\" rgb2=\"0.62 0.68 0.75\" width=\"256\" height=\"1536\"/>
    <texture name=\"floor\" type=\"2d\" builtin=\"checker\" rgb1=\"0.84 0.85 0.87\" rgb2=\"0.79 0.80 0.83\" width=\"256\" height=\"256\"/>
    <material name=\"floor\" texture=\"floor\" texuniform=\"true\" texrepeat=\"{0:.5} {0:.5}\" specular=\"0.1\"/>
    <material name=\"steel\" rgba=\"0.62 0.64 0.67 1\" specular=\"0.6\" shininess=\"0.6\"/>
    <material name=\"pointer\" rgba=\"0.96 0.75 0.26 1\"/>",
        0.1 / policy::MJCF_MODULE
    )?;
    for i in 0..scene.bodies.len() {
        let color = if i == 0 { COLORS[0] } else { COLORS[1 + (i - 1) % 2] };
        writeln!(
            out,
            "    <material name=\"gear{i}\" rgba=\"{color}\" specular=\"0.3\" shininess=\"0.4\"/>"
        )?;
    }
    for (i, body) in scene.bodies.iter().enumerate() {
        for (k, piece) in body.pieces.iter().enumerate() {
            write!(out, "    <mesh name=\"g{i}p{k}\" vertex=\"")?;
            for (n, p) in piece.iter().enumerate() {
                let [x, y] = [p.x, p.y].map(|v| format!("{v:.DECIMALS$}"));
                let gap = if n == 0 { "" } else { " " };
                write!(out, "{gap}{x} {y} 0 {x} {y} {:.3}", scene.thickness)?;
            }
            writeln!(out, "\"/>")?;
        }
    }
    writeln!(out, "  </asset>")
}

fn world(scene: &Scene<'_>, out: &mut String) -> std::fmt::Result {
    let (center, extent) = extent(scene);
    let height = scene.thickness;
    // Seen from above and a little from the front.
    let (sin, cos) = 65_f64.to_radians().sin_cos();
    let away = 1.2 * extent;
    writeln!(
        out,
        "  <worldbody>
    <light name=\"sun\" directional=\"true\" pos=\"{x:.3} {y:.3} {light:.3}\" dir=\"0.35 0.45 -1\" diffuse=\"0.55 0.55 0.55\"/>
    <camera name=\"overview\" pos=\"{x:.3} {front:.3} {above:.3}\" xyaxes=\"1 0 0 0 {sin:.5} {cos:.5}\" fovy=\"45\"/>
    <geom name=\"floor\" class=\"picture\" type=\"plane\" pos=\"{x:.3} {y:.3} {floor:.3}\" size=\"{size:.3} {size:.3} 1\" material=\"floor\"/>",
        x = center.x,
        y = center.y,
        light = 2.0 * extent,
        front = center.y - away * cos,
        above = away * sin,
        floor = -0.5 * height,
        size = 4.0 * extent,
    )?;
    for (i, body) in scene.bodies.iter().enumerate() {
        write_body(scene, i, body, out)?;
    }
    writeln!(out, "  </worldbody>")
}

fn write_body(scene: &Scene<'_>, i: usize, body: &Body<'_>, out: &mut String) -> std::fmt::Result {
    let name = escaped(body);
    let height = scene.thickness;
    let off_axis = policy::MJCF_OFF_AXIS * body.inertia;
    let rest = body.inertia - off_axis;
    let plane = policy::MJCF_PLANE_INERTIA * rest;
    writeln!(
        out,
        "    <body name=\"{name}\" pos=\"{x:.9} {y:.9} 0\" childclass=\"gear{i}\">
      <joint name=\"{name}\"/>
      <inertial pos=\"{d:.6} 0 {z:.6}\" mass=\"{mass:e}\" diaginertia=\"{plane:e} {plane:e} {rest:e}\"/>
      <geom class=\"picture\" type=\"cylinder\" fromto=\"0 0 {low:.4} 0 0 {high:.4}\" size=\"{axle:.4}\" material=\"steel\"/>
      <geom class=\"picture\" type=\"capsule\" fromto=\"0 0 {height:.4} {px:.4} {py:.4} {height:.4}\" size=\"{line:.4}\" material=\"pointer\"/>",
        x = body.axis.x,
        y = body.axis.y,
        d = body.off_axis,
        z = 0.5 * height,
        mass = off_axis / (body.off_axis * body.off_axis),
        low = -0.5 * height,
        high = 1.3 * height,
        axle = body.axle,
        px = body.pointer.x,
        py = body.pointer.y,
        line = 0.25 * policy::MJCF_MODULE,
    )?;
    for k in 0..body.pieces.len() {
        writeln!(out, "      <geom type=\"mesh\" mesh=\"g{i}p{k}\"/>")?;
    }
    writeln!(out, "    </body>")
}

/// Actuators, sensors and a state that turns already.
fn machinery(scene: &Scene<'_>, out: &mut String) -> std::fmt::Result {
    let options = scene.options;
    let stiffness = policy::MJCF_DRIVE * options.load / scene.speed;
    let last = &scene.bodies[scene.bodies.len() - 1];
    // It works against the rotation.
    let load = -last.speed_ratio.signum() * options.load;
    writeln!(
        out,
        "  <actuator>
    <general name=\"drive\" joint=\"{}\" gaintype=\"fixed\" gainprm=\"{stiffness}\" biastype=\"affine\" biasprm=\"{} 0 {}\"/>
    <general name=\"load\" joint=\"{}\" gaintype=\"fixed\" gainprm=\"{}\" biastype=\"affine\" biasprm=\"{load} 0 0\"/>
  </actuator>
  <sensor>",
        escaped(&scene.bodies[0]),
        stiffness * scene.speed,
        -stiffness,
        escaped(last),
        load.signum(),
    )?;
    for body in &scene.bodies {
        let name = escaped(body);
        writeln!(out, "    <jointpos name=\"{name}_angle\" joint=\"{name}\"/>")?;
    }
    writeln!(
        out,
        "    <actuatorfrc name=\"driver_torque\" actuator=\"drive\"/>
  </sensor>
</mujoco>"
    )
}

/// Middle of the scene, and the size of its larger side.
fn extent(scene: &Scene<'_>) -> (Point, f64) {
    let mut low = Point::new(f64::INFINITY, f64::INFINITY);
    let mut high = -low;
    for body in &scene.bodies {
        let reach = body.pieces.iter().flatten().map(|p| p.coords.norm()).fold(0.0, f64::max);
        low = low.inf(&(body.axis - Point::new(reach, reach)).into());
        high = high.sup(&(body.axis.coords.add_scalar(reach)).into());
    }
    let size = high - low;
    (Point::from(0.5 * (low.coords + high.coords)), size.x.max(size.y))
}

/// A gear's name, fit for an attribute.
fn escaped(body: &Body<'_>) -> String {
    let name = &body.placed.gear.name;
    let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;");
    name.replace('"', "&quot;").replace("--", "- -")
}
