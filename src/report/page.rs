//! One self-contained page on which the gears turn.

use super::contacts;
use super::data::{NoteKind, ReportData, Row, Section};
use super::plot::Scaled;
use super::rings::Rings;
use super::text::{Grid, escape, json_for_script, plain};
use crate::assembly::{Assembly, PlacedGear};
use crate::diagnose::{Code, Verdict};
use crate::geometry::{self, Point};
use crate::policy::{
    CLOSE_UP_PITCHES, PAGE_DIGITS, PAGE_FORCE_LENGTH, PAGE_MOTION_NUMBERS, PAGE_POINTS,
};
use serde_json::{Value, json};
use std::fmt::Write as _;

const STYLE: &str = include_str!("page.css");
const SCRIPT: &str = include_str!("page.js");

/// Nothing may be fetched: the page is what it is, wherever it is opened.
pub(super) const POLICY: &str =
    "default-src 'none'; img-src data:; style-src 'unsafe-inline'; script-src 'unsafe-inline'";

/// The page: turning gears, numbers, plots and notes in one HTML document.
///
/// Needs no network and no other file. Outlines and curves finer than a screen can show
/// are thinned, and long lists of contacts too, so that the page stays below about 1.5 MB. Without scripts it shows the first pose.
/// Opened as `report.html#angle=90` it stands still with the driver at 90 degrees.
#[must_use]
pub fn report_html(assembly: &Assembly, data: &ReportData) -> String {
    let stage = Stage::new(assembly);
    let plots: Vec<Scaled> = data.plots.iter().map(Scaled::new).collect();
    let title = escape(&data.title);
    let mut out = String::new();
    let _ = write!(
        out,
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{POLICY}\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n\
         <link rel=\"icon\" href=\"data:,\">\n<title>{title} – gear pair</title>\n\
         <style>\n{STYLE}</style>\n</head>\n<body>\n"
    );
    header(data, &mut out);
    out.push_str("<main>\n");
    stage.html(assembly, &mut out);
    out.push_str("<div class=\"side\">\n");
    notes(data, &mut out);
    for section in &data.sections {
        table(section, &mut out);
    }
    out.push_str("</div>\n<div class=\"plots\">\n");
    for (i, plot) in plots.iter().enumerate() {
        out.push_str(&plot.html(i));
    }
    out.push_str("</div>\n</main>\n");
    footer(data, &mut out);
    let block = json!({
        "title": data.title, "command": data.command, "made_by": data.made_by,
        "verdict": data.verdict, "summary": data.summary,
        "sections": data.sections, "notes": data.notes,
        "motion": stage.motion(assembly), "view": stage.view, "close_up": stage.close_up,
        "contacts": contacts::block(&data.contacts, stage.grid), "force_length": PAGE_FORCE_LENGTH,
        "plots": plots.iter().map(Scaled::json).collect::<Vec<_>>(),
    });
    let _ = write!(
        out,
        "<script type=\"application/json\" id=\"report-data\">{}</script>\n\
         <script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        json_for_script(&block)
    );
    out
}

fn header(data: &ReportData, out: &mut String) {
    let (class, sign, badge) = match data.verdict {
        Verdict::Good => ("good", "✓", "Good"),
        Verdict::Warnings => ("warn", "!", "Made with warnings"),
        Verdict::Unsound => ("bad", "×", "Not sound"),
    };
    let _ = write!(
        out,
        "<header>\n<h1>{}</h1>\n<p class=\"verdict {class}\"><b><i aria-hidden=\"true\">{sign}</i>{}</b> \
         <span>{}</span></p>\n</header>\n",
        escape(&data.title),
        badge,
        escape(&data.summary)
    );
}

fn footer(data: &ReportData, out: &mut String) {
    out.push_str("<footer>\n");
    if !data.command.is_empty() {
        let command = escape(&data.command);
        let _ = writeln!(out, "<p>Make it again with <code>{command}</code></p>");
    }
    let _ = writeln!(out, "<p>{}</p>\n</footer>", escape(&data.made_by));
}

fn notes(data: &ReportData, out: &mut String) {
    let list = |title: &str, class: &str, kinds: &[NoteKind], out: &mut String| {
        let chosen: Vec<_> = data.notes.iter().filter(|n| kinds.contains(&n.kind)).collect();
        if chosen.is_empty() {
            return;
        }
        let _ = write!(out, "<section class=\"card notes {class}\">\n<h2>{title}</h2>\n<ul>\n");
        for note in chosen {
            let kind = match note.kind {
                NoteKind::Step => "step",
                NoteKind::Warning => "warn",
                NoteKind::Fault => "bad",
            };
            let code = note.code.map_or("", Code::word);
            let text = escape(&note.text);
            let _ = writeln!(out, "<li class=\"{kind}\" data-code=\"{code}\">{text}</li>");
        }
        out.push_str("</ul>\n</section>\n");
    };
    list("Worth knowing", "warnings", &[NoteKind::Fault, NoteKind::Warning], out);
    list("How it was made", "steps", &[NoteKind::Step], out);
}

fn table(section: &Section, out: &mut String) {
    let _ = write!(
        out,
        "<section class=\"card numbers\">\n<h2>{}</h2>\n<table>\n",
        escape(&section.title)
    );
    for Row { label, value, note } in &section.rows {
        let note = note
            .as_ref()
            .map(|note| format!("<small>{}</small>", escape(note)))
            .unwrap_or_default();
        let _ = writeln!(
            out,
            "<tr><th scope=\"row\">{}{note}</th><td>{}</td></tr>",
            escape(label),
            escape(value)
        );
    }
    out.push_str("</table>\n</section>\n");
}

/// The drawing of the turning gears: y upwards, mm, thinned to what a screen shows.
struct Stage {
    grid: Grid,
    gears: Vec<Rings>,
    /// Left, top, width, height that hold the gears in every pose, y downwards, mm.
    view: [f64; 4],
    /// Width of the close-up, mm.
    close_up: f64,
    extent: f64,
}

impl Stage {
    fn new(assembly: &Assembly) -> Self {
        let full: Vec<Rings> = assembly.gears.iter().map(|g| Rings::of(&g.gear)).collect();
        let mut corners = Vec::new();
        for (placed, rings) in assembly.gears.iter().zip(&full) {
            let (axis, reach) = (axis_of(placed), rings.reach());
            corners.extend([-reach, reach].map(|r| axis + geometry::Vector::new(r, r)));
        }
        let (low, high) = match geometry::bounds(&corners) {
            (low, high) if high.x > low.x => (low, high),
            _ => (Point::new(-1.0, -1.0), Point::new(1.0, 1.0)),
        };
        let extent = (high.x - low.x).max(high.y - low.y);
        let margin = 0.02 * extent;
        let grid = Grid::for_extent(extent, PAGE_DIGITS);
        let mut tolerance = extent * 10f64.powi(-PAGE_DIGITS);
        let mut gears: Vec<Rings> = full.iter().map(|r| r.thinned(tolerance)).collect();
        while gears.iter().map(Rings::points).sum::<usize>() > PAGE_POINTS && tolerance < extent {
            tolerance *= 2.0;
            gears = gears.iter().map(|r| r.thinned(tolerance)).collect();
        }
        let pitch = assembly.gears.first().map_or(0.0, |placed| {
            geometry::perimeter(&full[0].pitch_curve) / f64::from(placed.gear.teeth.max(1))
        });
        let close_up = (CLOSE_UP_PITCHES * pitch).clamp(0.05 * extent, 0.5 * extent);
        let rounded = |v: f64| (v * 1e4).round() / 1e4;
        Self {
            grid,
            gears,
            view: [
                low.x - margin,
                -high.y - margin,
                high.x - low.x + 2.0 * margin,
                high.y - low.y + 2.0 * margin,
            ]
            .map(rounded),
            close_up: rounded(close_up),
            extent,
        }
    }

    /// Driver angle and each gear's angle at samples close enough to interpolate.
    fn motion(&self, assembly: &Assembly) -> Value {
        let count = assembly.driver_angle.len();
        let lists = assembly.gears.len() + 1;
        let most = (PAGE_MOTION_NUMBERS / lists).max(2);
        let stride = count.div_ceil(most).max(1);
        let mut picks: Vec<usize> = (0..count).step_by(stride).collect();
        if count > 0 && picks.last() != Some(&(count - 1)) {
            picks.push(count - 1);
        }
        let rounded = |v: f64| if v.is_finite() { (v * 1e6).round() / 1e6 } else { 0.0 };
        let pick = |list: &[f64]| -> Vec<f64> {
            let value = |i: &usize| list.get(*i).or(list.last()).copied().unwrap_or(0.0);
            picks.iter().map(value).map(rounded).collect()
        };
        let gears: Vec<Value> = assembly
            .gears
            .iter()
            .map(|placed| {
                let axis = axis_of(placed);
                json!({
                    "name": placed.gear.name, "teeth": placed.gear.teeth,
                    "axis": [rounded(axis.x), rounded(axis.y)], "angle": pick(&placed.angle),
                })
            })
            .collect();
        json!({ "driver_angle": pick(&assembly.driver_angle), "gears": gears })
    }

    fn html(&self, assembly: &Assembly, out: &mut String) {
        let [x, y, w, h] = self.view;
        let names: Vec<_> = assembly.gears.iter().map(|g| escape(&g.gear.name)).collect();
        let unit = self.extent / 100.0;
        let n = |v: f64| self.grid.number(v);
        let ruled = ruling(self.extent);
        let step = n(ruled);
        let _ = write!(
            out,
            "<section class=\"card stage\" aria-label=\"Gears in motion\">\n\
             <svg id=\"gears\" viewBox=\"{x} {y} {w} {h}\" role=\"img\" aria-label=\"{} in mesh\">\n\
             <defs><pattern id=\"ruling\" width=\"{step}\" height=\"{step}\" patternUnits=\"userSpaceOnUse\">\
             <path d=\"M0 0H{step}M0 0V{step}\"/></pattern></defs>\n\
             <rect class=\"ruling\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"url(#ruling)\"/>\n\
             <g transform=\"scale(1 -1)\" stroke-linejoin=\"round\">\n",
            names.join(" and "),
            n(x - 2.0 * w),
            n(y - 2.0 * h),
            n(5.0 * w),
            n(5.0 * h),
        );
        let layer = |name: &str, ring: &dyn Fn(&Rings) -> String, out: &mut String| {
            let _ = writeln!(out, "<g class=\"layer {name}\">");
            for (i, (placed, rings)) in assembly.gears.iter().zip(&self.gears).enumerate() {
                let axis = axis_of(placed);
                let _ = writeln!(
                    out,
                    "<path class=\"g{}\" data-gear=\"{i}\" transform=\"translate({} {})\" d=\"{}\"/>",
                    i % 2,
                    n(axis.x),
                    n(axis.y),
                    ring(rings)
                );
            }
            out.push_str("</g>\n");
        };
        let all =
            |rings: &[Vec<Point>]| rings.iter().map(|r| self.grid.ring(r)).collect::<String>();
        layer("ghost", &|r| self.grid.ring(&r.input) + &all(&r.holes), out);
        layer("body", &|r| self.grid.ring(&r.outline) + &all(&r.holes), out);
        layer("marks", &|r| all(&r.marks), out);
        layer("drawing", &|r| self.grid.ring(&r.input), out);
        layer("pitch", &|r| self.grid.ring(&r.pitch_curve), out);
        let centers: Vec<Point> = assembly.gears.iter().map(axis_of).collect();
        let arm = 1.4 * unit;
        let mut marks = String::new();
        for c in &centers {
            let (left, low, arms) = (n(c.x - arm), n(c.y - arm), n(2.0 * arm));
            let _ = write!(marks, "M{left} {}h{arms}M{} {low}v{arms}", n(c.y), n(c.x));
        }
        let line = self.grid.line(&centers);
        let _ = write!(
            out,
            "<g class=\"layer axes\"><path class=\"light\" d=\"{line}\"/>\
             <path class=\"centers\" d=\"{line}\"/><path class=\"halo\" d=\"{marks}\"/>\
             <path d=\"{marks}\"/></g>\n\
             <g class=\"layer contacts\"><path class=\"halo\"/><path class=\"force\"/><path class=\"touch\"/></g>\n\
             </g>\n</svg>\n"
        );
        self.caption(assembly, ruled, out);
        out.push_str(CONTROLS);
        out.push_str("</section>\n");
    }

    fn caption(&self, assembly: &Assembly, ruled: f64, out: &mut String) {
        out.push_str("<ul class=\"key\">\n");
        for (i, placed) in assembly.gears.iter().enumerate() {
            let gear = &placed.gear;
            let _ = writeln!(
                out,
                "<li><i class=\"g{}\"></i>{}, {} teeth <output data-angle=\"{i}\">0.0°</output></li>",
                i % 2,
                escape(&gear.name),
                gear.teeth
            );
        }
        if let [a, b] = &assembly.gears[..] {
            let distance = plain((axis_of(b) - axis_of(a)).norm(), 4);
            let _ = writeln!(out, "<li>centre distance {distance} mm</li>");
        }
        let _ = writeln!(out, "<li class=\"faint\">ruling {} mm</li>\n</ul>", plain(ruled, 6));
    }
}

const CONTROLS: &str = r#"<div class="controls" hidden>
<button type="button" id="play" aria-pressed="false">Play</button>
<label class="slide"><span>Driver angle</span><input type="range" id="angle" min="0" max="360" step="0.25" value="0"></label>
<label>Speed <select id="speed"><option value="0.1">0.1×</option><option value="0.25">¼×</option><option value="0.5">½×</option><option value="1" selected>1×</option><option value="2">2×</option><option value="4">4×</option></select></label>
<fieldset><legend>Show</legend>
<label><input type="checkbox" data-layer="body" checked> gears</label>
<label><input type="checkbox" data-layer="input" checked> drawings</label>
<label><input type="checkbox" data-layer="pitch" checked> pitch curves</label>
<label><input type="checkbox" data-layer="axes" checked> axes</label>
<label id="contacts" title="Where the teeth press on each other, and the force on the follower; the longest line is the greatest usual force of the run" hidden><input type="checkbox" data-layer="contacts" checked> contact and forces</label>
<label><input type="checkbox" id="close-up"> close-up of the mesh</label>
</fieldset>
</div>
<noscript><p class="faint">Allow scripts to see the gears turn.</p></noscript>
"#;

fn axis_of(placed: &PlacedGear) -> Point {
    let finite = placed.axis.x.is_finite() && placed.axis.y.is_finite();
    if finite { placed.axis } else { Point::origin() }
}

/// Spacing of the ruling behind the gears, mm: a power of ten, 6 to 60 lines across.
fn ruling(extent: f64) -> f64 {
    10f64.powf((extent / 6.0).log10().floor())
}

#[cfg(test)]
mod tests {
    use super::super::{ContactFrame, Note, Plot, Touch, fixture};
    use super::*;

    fn page() -> String {
        report_html(&fixture::ellipses(), &fixture::report())
    }

    fn block(html: &str) -> Value {
        let (_, rest) = html.split_once("id=\"report-data\">").expect("the data block");
        let (text, _) = rest.split_once("</script>").expect("the end of the data block");
        serde_json::from_str(text).expect("the data block is JSON")
    }

    #[test]
    fn the_page_loads_nothing() {
        let html = page();
        assert!(html.contains("default-src 'none'"));
        for word in ["http:", "https:", "src=", "@import", "url(http", "//cdn"] {
            assert!(!html.contains(word), "{word}");
        }
        assert_eq!(html.matches("href=").count(), 1, "only the empty icon");
    }

    #[test]
    fn the_same_input_gives_the_same_page() {
        assert_eq!(page(), page());
    }

    #[test]
    fn the_motion_in_the_page_closes_and_follows_the_closed_form() {
        let data = block(&page());
        let list = |v: &Value| -> Vec<f64> {
            v.as_array().expect("a list").iter().filter_map(Value::as_f64).collect()
        };
        let phi = list(&data["motion"]["driver_angle"]);
        let follower = list(&data["motion"]["gears"][1]["angle"]);
        assert_eq!(phi.len(), follower.len());
        assert!((phi[phi.len() - 1] - std::f64::consts::TAU).abs() < 1e-6);
        assert!((follower[follower.len() - 1] + std::f64::consts::TAU).abs() < 1e-6);
        for (p, f) in phi.iter().zip(&follower).filter(|(p, _)| **p < 3.0) {
            // tan(psi / 2) = 3 tan(phi / 2)
            assert!(
                ((-0.5 * f).tan() - 3.0 * (0.5 * p).tan()).abs()
                    < 1e-3 * (0.5 * f).tan().abs().max(1.0)
            );
        }
    }

    #[test]
    fn the_contacts_are_in_the_page_and_hidden_where_there_are_none() {
        assert_eq!(block(&page())["contacts"], json!([]));
        let touch = |x, y| Touch { x, y, force: [-0.342_02, 0.939_69] };
        let mut data = fixture::report();
        data.contacts = vec![
            ContactFrame { driver_angle: 0.032_725, touches: vec![touch(39.123_456, -1.5)] },
            ContactFrame { driver_angle: 0.065_46, touches: Vec::new() },
        ];
        let html = report_html(&fixture::ellipses(), &data);
        let wanted = json!([[0.0327, 39.123, -1.5, -0.342, 0.9397], [0.0655]]);
        assert_eq!(block(&html)["contacts"], wanted);
        // The script shows the switch; without contacts, or without scripts, nobody sees it.
        let (_, switch) = html.split_once("<label id=\"contacts\"").expect("the switch");
        assert!(switch.split_once('>').is_some_and(|(tag, _)| tag.ends_with(" hidden")));
        assert!(html.contains("<g class=\"layer contacts\">"));
    }

    #[test]
    fn hostile_names_stay_text() {
        let evil = "</script><script>alert(1)</script><img src=x onerror=alert(1)>\"'&";
        let mut assembly = fixture::ellipses();
        assembly.gears[0].gear.name = evil.into();
        let mut data = fixture::report();
        data.title = evil.into();
        data.command = evil.into();
        data.made_by = evil.into();
        data.summary = evil.into();
        data.sections = vec![Section::new(evil).noted_row(evil, evil, evil)];
        data.notes = vec![Note::new(NoteKind::Fault, evil)];
        data.plots = vec![
            Plot::over_driver_angle(evil, evil)
                .series(evil, vec![(0.0, 1.0), (1.0, 2.0)])
                .limit(evil, 1.5),
        ];
        let html = report_html(&assembly, &data);
        assert!(!html.contains("<script>alert") && !html.contains("<img"));
        assert_eq!(html.matches("</script>").count(), 2);
        let data = block(&html);
        assert_eq!(data["title"], evil);
        assert_eq!(data["plots"][0]["series"][0]["name"], evil);
        assert_eq!(data["motion"]["gears"][0]["name"], evil);
    }

    #[test]
    fn very_fine_outlines_still_make_a_small_page() {
        let mut assembly = fixture::ellipses();
        let fine: Vec<Point> = (0..100_000)
            .map(|i| {
                let t = std::f64::consts::TAU * f64::from(i) / 100_000.0;
                let r = 40.0 + (5000.0 * t).sin();
                Point::new(r * t.cos(), r * t.sin())
            })
            .collect();
        assembly.gears[0].gear.outline = fine.clone();
        assembly.gears[1].gear.outline = fine;
        let html = report_html(&assembly, &fixture::report());
        assert!(html.len() < 1_500_000, "{}", html.len());
        assert!(html.len() > 200_000, "the outlines are still there: {}", html.len());
    }

    #[test]
    fn broken_assemblies_still_make_a_page() {
        let mut assembly = fixture::ellipses();
        assembly.gears[0].gear.outline[3].y = f64::NAN;
        assembly.gears[0].angle[5] = f64::INFINITY;
        assembly.gears[1].axis.x = f64::NAN;
        assembly.gears[1].angle.clear();
        let html = report_html(&assembly, &fixture::report());
        block(&html);
        let (drawing, _) = html.split_once("id=\"report-data\"").expect("the data block");
        assert!(!drawing.contains("NaN") && !drawing.contains("inf "));
        assembly.gears.clear();
        assembly.driver_angle.clear();
        block(&report_html(&assembly, &fixture::report()));
    }
}
