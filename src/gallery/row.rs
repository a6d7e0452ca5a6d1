//! One pair of a gallery, and the tables of all of them.

use serde::{Deserialize, Serialize};

use super::Thumbnail;
use crate::pipeline::Design;

/// One pair: what became of it. Says nothing of the time it took, so that the same pair gives the same row anywhere.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// Name of its folder.
    pub folder: String,
    /// Name of the driver's shape.
    pub driver: String,
    /// Name of the follower's shape.
    pub follower: String,
    /// K.
    pub ratio: String,
    /// `good`, `warnings`, `unsound`, `unjudged` (pitch curves only), or `refused` where nothing was made.
    pub verdict: String,
    /// Its numbers; none where nothing was made.
    pub figures: Option<Figures>,
    /// Why it is unsound or refused, or what deserves attention.
    pub remarks: Vec<String>,
    /// Stands for all that the row depends on: both outlines, the options and the program's version.
    pub fingerprint: String,
    /// For the page.
    pub thumbnail: Option<Thumbnail>,
}

/// Numbers of a pair that was made.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Figures {
    /// E of Eq. 11.
    pub e: f64,
    /// E_s.
    pub shape: f64,
    /// What the search made small: E with the costs of bounds and of repeating a window for K > 1.
    pub total: f64,
    /// Greatest psi' of the finished pitch curves: the driver's torque over the load.
    pub torque: f64,
    /// Likeness of driver and follower: area of intersection over union.
    pub iou: [f64; 2],
    /// Teeth of both; none without teeth.
    pub teeth: Option<[u32; 2]>,
    /// Module, mm.
    pub module: Option<f64>,
    /// Steepest lean, radians.
    pub lean: f64,
    /// 99th percentile of the transmission error, in pitches.
    pub transmission_error: Option<f64>,
    /// Poses at which contact was lost, and poses looked at.
    pub lost_poses: Option<[usize; 2]>,
    /// Vertices of both outlines.
    pub vertices: Option<[usize; 2]>,
}

impl Figures {
    /// Of a finished pair.
    #[must_use]
    pub fn of(design: &Design) -> Self {
        // A gallery's designs are fitted to two shapes, so they have both.
        let objective = design.objective().copied().unwrap_or_default();
        let summary = &design.contact.summary;
        let count = |i: usize| design.assembly.gears.get(i).map_or(0, |g| g.gear.outline.len());
        Self {
            e: objective.shape + objective.weight * objective.torque,
            shape: objective.shape,
            total: objective.total,
            torque: design.centrodes.transmission.max_derivative(),
            iou: design.likeness.map(Option::unwrap_or_default),
            teeth: Some(design.teeth),
            module: Some(design.pair.module),
            lean: design.centrodes.max_lean(),
            transmission_error: design
                .exact_contact
                .summary
                .transmission_error_pitch
                .as_ref()
                .map(|e| e.p99_deviation),
            lost_poses: Some([
                summary.lost_poses + summary.lost_poses_reversed,
                design.contact.poses.len(),
            ]),
            vertices: Some([count(0), count(1)]),
        }
    }
}

/// The rows by rising E, as in the paper; those without figures last, all by name where E is the same.
#[must_use]
pub fn sorted(mut rows: Vec<Row>) -> Vec<Row> {
    let e = |r: &Row| r.figures.as_ref().map_or(f64::INFINITY, |f| f.e);
    rows.sort_by(|a, b| e(a).total_cmp(&e(b)).then_with(|| a.folder.cmp(&b.folder)));
    rows
}

const COLUMNS: [&str; 20] = [
    "driver",
    "follower",
    "K",
    "verdict",
    "E",
    "E_s",
    "total",
    "max_psi_prime",
    "driver_iou",
    "follower_iou",
    "driver_teeth",
    "follower_teeth",
    "module_mm",
    "lean_deg",
    "transmission_error_p99_percent",
    "lost_poses",
    "poses",
    "driver_vertices",
    "follower_vertices",
    "remarks",
];

/// The table, one row a pair, in the order given; RFC 4180, lines end in a line feed. The folder is the last column.
#[must_use]
pub fn to_csv(rows: &[Row]) -> String {
    let mut text = COLUMNS.join(",") + ",folder\n";
    for row in rows {
        let mut cells = vec![
            quoted(&row.driver),
            quoted(&row.follower),
            row.ratio.clone(),
            row.verdict.clone(),
        ];
        match &row.figures {
            Some(f) => {
                cells.extend([f.e, f.shape, f.total, f.torque, f.iou[0], f.iou[1]].map(fixed));
                cells.extend(two(f.teeth));
                cells.push(f.module.map(fixed).unwrap_or_default());
                cells.push(fixed(f.lean.to_degrees()));
                cells.push(f.transmission_error.map(|e| fixed(100.0 * e)).unwrap_or_default());
                cells.extend(two(f.lost_poses));
                cells.extend(two(f.vertices));
            }
            None => cells.extend((cells.len()..COLUMNS.len() - 1).map(|_| String::new())),
        }
        cells.push(quoted(&row.remarks.join("; ")));
        cells.push(quoted(&row.folder));
        text.push_str(&cells.join(","));
        text.push('\n');
    }
    text
}

fn fixed(value: f64) -> String {
    format!("{value:.6}")
}

fn two<T: ToString>(both: Option<[T; 2]>) -> [String; 2] {
    both.map_or_else(|| [String::new(), String::new()], |b| b.map(|v| v.to_string()))
}

fn quoted(text: &str) -> String {
    if text.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}

/// The same for programs, without thumbnails.
#[must_use]
pub fn to_json(rows: &[Row]) -> serde_json::Value {
    let plain: Vec<Row> = rows.iter().map(|r| Row { thumbnail: None, ..r.clone() }).collect();
    serde_json::json!({ "centrode": env!("CARGO_PKG_VERSION"), "pairs": plain })
}

#[cfg(test)]
pub(super) mod tests {
    use super::*;

    pub(in crate::gallery) fn row(name: &str, e: Option<f64>) -> Row {
        Row {
            folder: format!("{name}-k1"),
            driver: name.to_owned(),
            follower: "b, \"c\"".to_owned(),
            ratio: "1".to_owned(),
            verdict: if e.is_some() { "good" } else { "refused" }.to_owned(),
            figures: e.map(|e| Figures {
                e,
                shape: 0.1,
                total: 0.4,
                torque: 1.5,
                iou: [0.9, 0.8],
                teeth: Some([32, 32]),
                module: Some(1.0),
                lean: 0.5,
                transmission_error: Some(0.001),
                lost_poses: Some([0, 480]),
                vertices: Some([900, 901]),
            }),
            remarks: if e.is_some() { vec![] } else { vec!["no </script> room".to_owned()] },
            fingerprint: "0".to_owned(),
            thumbnail: None,
        }
    }

    #[test]
    fn rows_rise_in_e_and_fill_every_column() {
        let rows = sorted(vec![
            row("x", None),
            row("b", Some(0.5)),
            row("a", Some(0.5)),
            row("z", Some(0.2)),
        ]);
        let order: Vec<&str> = rows.iter().map(|r| r.driver.as_str()).collect();
        assert_eq!(order, ["z", "a", "b", "x"]);
        let text = to_csv(&rows);
        let mut lines = text.lines();
        let head = lines.next().unwrap().matches(',').count();
        for line in lines {
            // Two commas more than the head has: those in the quoted name.
            let quotes = line.matches("\"b, \"\"c\"\"\"").count();
            assert_eq!(line.matches(',').count() - quotes, head, "{line}");
        }
        let parsed: Vec<Row> = serde_json::from_value(to_json(&rows)["pairs"].clone()).unwrap();
        assert_eq!(parsed, rows);
    }
}
