use super::*;
use std::f64::consts::PI;

const TOLERANCE: f64 = policy::FLATTEN_TOLERANCE;

fn drawing(body: &str) -> String {
    format!(
        r#"<svg xmlns="http://www.w3.org/2000/svg" xmlns:xlink="http://www.w3.org/1999/xlink"
        viewBox="0 0 100 100">{body}</svg>"#
    )
}

fn read(body: &str) -> Result<Outline, SvgError> {
    from_svg(drawing(body).as_bytes(), TOLERANCE)
}

fn area(body: &str) -> f64 {
    read(body).unwrap().area()
}

fn near(a: f64, b: f64, relative: f64) {
    assert!((a - b).abs() <= relative * b.abs(), "{a} is not {b}");
}

#[test]
fn a_circle_is_flattened_to_the_tolerance() {
    let body = r#"<circle cx="50" cy="50" r="40"/>"#;
    for tolerance in [1e-3, 1e-4, 1e-5] {
        let outline = from_svg(drawing(body).as_bytes(), tolerance).unwrap();
        let worst = outline.points().iter().zip(outline.points().iter().cycle().skip(1)).fold(
            0.0,
            |worst: f64, (a, b)| {
                let middle = nalgebra::center(a, b) - Point::new(50.0, 50.0);
                worst.max((middle.norm() - 40.0).abs())
            },
        );
        // Four cubic arcs differ from a circle by 2.7e-4 of the radius themselves.
        assert!(worst < tolerance * 80.0 * 2_f64.sqrt() + 2.8e-4 * 40.0, "{tolerance}: {worst}");
    }
    near(area(body), PI * 1600.0, 1e-3);
}

#[test]
fn y_points_upwards() {
    let outline = read(r#"<path d="M10 90 L90 90 L50 10 Z"/>"#).unwrap();
    let top = outline.points().iter().max_by(|a, b| a.y.total_cmp(&b.y)).unwrap();
    assert_eq!(*top, Point::new(50.0, 90.0));
    assert!(geometry::signed_area(outline.points()) > 0.0);
}

#[test]
fn the_largest_filled_path_wins_and_strokes_do_not_count() {
    let body = r#"<rect x="1" y="1" width="97" height="97" fill="none" stroke="red"/>
        <rect x="10" y="10" width="5" height="5"/>
        <rect x="30" y="30" width="20" height="10" stroke="black" stroke-width="9"/>"#;
    near(area(body), 200.0, 1e-6);
}

#[test]
fn clip_paths_of_style_sheets_apply_and_shapes_of_css_are_refused() {
    let shape = r##"<rect class="c" x="10" y="10" width="80" height="80"/>"##;
    let clip = r##"<clipPath id="k"><rect x="30" y="30" width="40" height="40"/></clipPath>"##;
    let sheet = "<style>.c { fill: red; clip-path: url(#k) }</style>";
    near(area(&format!("{sheet}{clip}{shape}")), 1600.0, 1e-6);
    let mask = r##"<mask id="k"><rect x="30" y="30" width="40" height="40" fill="white"/></mask>"##;
    let sheet = "<style>.c { mask: url('#k') }</style>";
    near(area(&format!("{sheet}{mask}{shape}")), 1600.0, 1e-6);
    // To itself, and to everything: no circle, no refusal.
    let sheet = "<style>* { clip-path: url(#k) }</style>";
    near(area(&format!("{sheet}{clip}{shape}")), 1600.0, 1e-6);
    for css in [".c { clip-path: circle(40px) }", ".c{clip-path:inset(5px)!important}"] {
        let found = read(&format!("<style>{css}</style>{shape}"));
        assert!(matches!(found, Err(SvgError::Cover { .. })), "{css}");
    }
    let turned = r##"<clipPath id="k"><use href="#x"/></clipPath><rect class="c" id="x" width="9" height="9"/>"##;
    let found = read(&format!("<style>.c {{ clip-path: url(#k) }}</style>{turned}"));
    assert!(matches!(found, Err(SvgError::Cover { .. })));
}

#[test]
fn transforms_groups_use_and_styles_apply() {
    let body = r##"<style>.hidden { display: none }</style>
        <defs><g id="bar"><rect width="10" height="20"/></g></defs>
        <rect class="hidden" width="90" height="90"/>
        <g transform="translate(20 10) scale(2)"><use xlink:href="#bar" x="5" transform="rotate(30)"/></g>
        <use href="#bar" style="visibility: hidden" transform="scale(4)"/>"##;
    near(area(body), 800.0, 1e-5);
}

#[test]
fn touching_paths_are_united_and_holes_dropped() {
    near(area(r#"<path d="M10 10h20v20h-20z"/><path d="M30 15h10v10h-10z"/>"#), 500.0, 1e-6);
    let overlapping = r#"<circle cx="30" cy="50" r="20"/><circle cx="60" cy="50" r="20"/>"#;
    // Two discs less their lens: 2 r^2 acos(d/2r) - d/2 sqrt(4r^2 - d^2).
    let lens = 800.0 * 0.75_f64.acos() - 15.0 * (1600.0_f64 - 900.0).sqrt();
    near(area(overlapping), 2.0 * PI * 400.0 - lens, 1e-3);
    let ring = r#"<path fill-rule="evenodd" d="M10 10h40v40h-40z M20 20h20v20h-20z"/>"#;
    near(area(ring), 1600.0, 1e-6);
    let curves = r#"<path d="M20 20 C40 0 60 60 80 20 L80 80 L20 80Z"/>
        <path d="M80 20 C60 60 40 0 20 20 L20 5 L80 5Z"/>"#;
    near(area(curves), 4500.0, 1e-4);
    let tangent = r#"<circle cx="30" cy="50" r="20"/><circle cx="70" cy="50" r="20"/>"#;
    near(area(tangent), 2.0 * PI * 400.0, 2e-3);
}

#[test]
fn a_background_behind_the_shape_is_left_out() {
    let body = r#"<rect width="100" height="100" fill="white"/><rect x="20" y="20" width="30" height="30"/>"#;
    near(area(body), 900.0, 1e-6);
    near(area(r#"<rect width="100" height="100"/>"#), 10_000.0, 1e-6);
    let card = r#"<rect width="100" height="100" rx="10" fill="white"/>"#;
    near(area(&format!(r#"{card}<rect x="20" y="20" width="30" height="30"/>"#)), 900.0, 1e-6);
    near(area(card), 10_000.0 - (4.0 - PI) * 100.0, 1e-3);
    // A disc that touches all sides is no background.
    let disc = r#"<circle cx="50" cy="50" r="50"/><rect width="3" height="3"/>"#;
    near(area(disc), PI * 2500.0, 2e-3);
}

#[test]
fn what_is_wholly_transparent_is_left_out() {
    let small = r#"<rect x="20" y="20" width="30" height="30"/>"#;
    let large = r#"<rect width="90" height="80"/>"#;
    near(area(&format!(r#"<g opacity="0"><g>{large}</g></g>{small}"#)), 900.0, 1e-6);
    near(area(&format!(r#"<g opacity="0.5">{large}</g>{small}"#)), 7200.0, 1e-6);
    let hidden = read(&format!(r#"<g opacity="0">{large}</g>"#)).unwrap_err();
    assert_eq!(hidden, SvgError::NothingFilled);
}

#[test]
fn shapes_too_small_for_arcs_are_refused() {
    let of = |size: f64| {
        let text = format!(
            r#"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {size} {size}">
            <ellipse cx="{c}" cy="{c}" rx="{rx}" ry="{ry}"/></svg>"#,
            c = 0.5 * size,
            rx = 0.4 * size,
            ry = 0.3 * size
        );
        from_svg(text.as_bytes(), TOLERANCE)
    };
    near(of(0.01).unwrap().area(), 0.12 * PI * 1e-4, 1e-3);
    for size in [1e-4, 1e-6] {
        let error = of(size).unwrap_err();
        assert!(matches!(error, SvgError::Tiny { .. }), "{error:?}");
        assert!(error.to_string().contains("; scale the drawing up"), "{error}");
    }
}

#[test]
fn open_filled_paths_are_closed_as_viewers_do_and_it_is_said() {
    near(area(r#"<path d="M10 10 L90 10 L90 90 L10 90 L10 11"/>"#), 6400.0, 1e-2);
    let of = |body: &str| shape(drawing(body).as_bytes(), TOLERANCE, None, None).unwrap();
    let Drawing { outline, notes, .. } = of(r#"<path d="M10 10 L90 10 L90 90"/>"#);
    near(outline.area(), 3200.0, 1e-6);
    let (from, to) = (Point::new(10.0, 90.0), Point::new(90.0, 10.0));
    assert_eq!(notes, [Note::ClosedByLine { from, to }]);
    assert!(of(r#"<path d="M10 10 L90 10 L90 90Z"/>"#).notes.is_empty());
}

#[test]
fn drawings_of_lines_alone_are_read_by_their_lines() {
    near(area(r#"<path d="M10 10 H90 V90 H10Z" fill="none" stroke="black"/>"#), 6400.0, 1e-6);
    let sides = r#"<path d="M10 10 H90" fill="none" stroke="black"/>
        <path d="M90 90 H10 V10" fill="none" stroke="black"/><path d="M90 10 V90" fill="none" stroke="black"/>"#;
    near(area(sides), 6400.0, 1e-6);
    let open = r#"<path d="M10 10 L90 10 L90 90" fill="none" stroke="black"/>"#;
    let error = read(open).unwrap_err();
    assert!(matches!(error, SvgError::Lines { .. }), "{error:?}");
    assert!(error.to_string().contains("(10.0000, 90.0000)"), "{error}");
}

#[test]
fn clip_paths_and_masks_cut_as_viewers_show() {
    let disc = r#"<clipPath id="c"><circle cx="50" cy="50" r="40"/></clipPath>"#;
    let square = r#"<rect width="100" height="100" clip-path="url(#c)"/>"#;
    near(area(&format!("{disc}<g transform='translate(0 0)'>{square}</g>")), PI * 1600.0, 2e-3);
    let half = r#"<mask id="m"><rect width="50" height="100" fill="white"/></mask><rect x="10" y="10" width="80" height="80" mask="url(#m)"/>"#;
    near(area(half), 3200.0, 1e-3);
    let bite = r#"<mask id="m"><rect width="100" height="100" fill="white"/><rect width="50" height="100"/></mask>
        <rect x="10" y="10" width="80" height="80" mask="url(#m)"/>"#;
    near(area(bite), 3200.0, 1e-3);
}

#[test]
fn paint_of_the_ground_is_no_shape() {
    let shape = r#"<rect x="20" y="20" width="40" height="40"/>"#;
    // White over it cuts, white under it does nothing, white about it with holes is paper.
    let over = format!(r##"{shape}<rect x="40" y="0" width="60" height="100" fill="#fff"/>"##);
    near(area(&over), 800.0, 1e-6);
    near(area(&format!(r#"<rect width="95" height="95" fill="white"/>{shape}"#)), 1600.0, 1e-6);
    let about = r#"<path fill="white" fill-rule="evenodd" d="M0 0H100V100H0Z M20 20H60V60H20Z"/>"#;
    near(area(&format!("{shape}{about}")), 1600.0, 1e-6);
    // A ground of another colour, in pieces.
    let bands = r##"<rect width="100" height="50" fill="#fec"/><rect y="50" width="100" height="50" fill="#fec"/>"##;
    near(area(&format!("{bands}{shape}")), 1600.0, 1e-6);
    let light = r#"<rect width="100" height="100"/><circle cx="50" cy="50" r="30" fill="white"/>"#;
    near(area(light), PI * 900.0, 2e-3);
    // White within a line is drawn to be seen, a sheet with a border is not.
    near(area(r#"<path d="M20 20H60V60H20Z" fill="white" stroke="black"/>"#), 1600.0, 1e-6);
    let sheet = r#"<rect x="5" y="5" width="90" height="90" fill="white" stroke="black"/>"#;
    near(area(&format!("{sheet}{shape}")), 1600.0, 1e-6);
}

#[test]
fn places_are_in_the_drawing_s_own_units() {
    let of = |root: &str, body: &str| {
        let text = format!(r#"<svg xmlns="http://www.w3.org/2000/svg" {root}>{body}</svg>"#);
        from_svg(text.as_bytes(), TOLERANCE).unwrap().bounds().0
    };
    let rect = r#"<rect x="10" y="20" width="30" height="40"/>"#;
    for (root, x, y) in [
        (r#"width="210mm" height="297mm" viewBox="0 0 210 297""#, 10.0, 237.0),
        (r#"width="595pt" height="842pt" viewBox="0 0 595 842""#, 10.0, 782.0),
        (r#"viewBox="-50 -50 100 200""#, 10.0, 40.0),
        (r#"width="300" height="600" viewBox="0 0 100 200""#, 10.0, 140.0),
        (r#"width="100mm" height="100mm" viewBox="0 0 1000 1000""#, 1.0, 94.0),
    ] {
        let low = of(root, rect);
        assert!((low - Point::new(x, y)).norm() < 1e-3, "{root}: {low}");
    }
}

#[test]
fn other_encodings_and_parts_by_name_are_read() {
    let text = drawing(
        r#"<g id="blume-ö"><rect width="9" height="9"/></g><rect id="b" x="20" width="20" height="20"/>"#,
    );
    let latin: Vec<u8> = text.chars().map(|c| u8::try_from(u32::from(c)).unwrap()).collect();
    near(from_svg(&latin, TOLERANCE).unwrap().area(), 400.0, 1e-6);
    let wide: Vec<u8> = text.encode_utf16().flat_map(u16::to_le_bytes).collect();
    near(from_svg(&[b"\xff\xfe", &wide[..]].concat(), TOLERANCE).unwrap().area(), 400.0, 1e-6);
    let part = |name: &str| shape(text.as_bytes(), TOLERANCE, Some(name), None);
    near(part("blume-ö").unwrap().outline.area(), 81.0, 1e-6);
    near(part("2").unwrap().outline.area(), 81.0, 1e-6);
    assert!(matches!(part("stem"), Err(SvgError::NoSuchPart { .. })));
}

#[test]
fn drawings_far_from_the_origin_are_refused() {
    let far = r#"<path d="M5000000 5000000 h10 v10 h-10z"/>"#;
    assert!(matches!(read(far).unwrap_err(), SvgError::FarAway { .. }));
}

#[test]
fn drawings_without_a_filled_path_say_why() {
    assert_eq!(read("").unwrap_err(), SvgError::Empty);
    assert_eq!(read("<g/>").unwrap_err(), SvgError::Empty);
    assert_eq!(read("<text x='9' y='9'>gear</text>").unwrap_err(), SvgError::OnlyText);
    let image = "<image width='9' height='9' href='data:image/png;base64,AAAA'/>";
    assert_eq!(read(image).unwrap_err(), SvgError::OnlyImages);
    for reference in ["<image width='9' height='9' href='/etc/hostname'/>", "<use href='a.svg#b'/>"]
    {
        assert_eq!(read(reference).unwrap_err(), SvgError::OnlyReferences);
    }
    assert_eq!(read("<path d='M1 1 L9 9Z'/>").unwrap_err(), OutlineError::NoArea.into());
    for data in ["M10 50 A nan 3 0 0 1 90 50z", "90 50 L1 1", "M5 5 L 9", "M5 5 x", "M1 1 L"] {
        let error = read(&format!("<path d='{data}'/>")).unwrap_err();
        assert_eq!(error, SvgError::PathData { text: data.into() });
    }
    for data in ["", "M1-1.5.5.5l1e-3,2E+1 3 4zm1 1a1 2 0 0150-3Z", "m 0,0 h1 2 v3 C1 1 2 2 3 3"] {
        let hidden = read(&format!("<path fill='none' d='{data}'/>")).unwrap_err();
        assert_eq!(hidden, SvgError::NothingFilled, "{data}");
    }
    near(area("<polyline points='10,10 90,10 50,80'/>"), 2800.0, 1e-6);
}

#[test]
fn references_to_files_are_never_read() {
    let folder = tempfile::tempdir().unwrap();
    let big = folder.path().join("big.svg");
    std::fs::write(&big, drawing(r#"<rect width="90" height="90"/>"#)).unwrap();
    let body = format!(
        r#"<image width="90" height="90" href="{0}"/><use href="{0}#a"/><rect width="3" height="3"/>"#,
        big.display()
    );
    near(area(&body), 9.0, 1e-6);
    let entity = format!(
        r#"<!DOCTYPE svg [<!ENTITY e SYSTEM "{}">]>{}"#,
        big.display(),
        drawing("&e;<rect width='3' height='3'/>")
    );
    if let Ok(outline) = from_svg(entity.as_bytes(), TOLERANCE) {
        near(outline.area(), 9.0, 1e-6);
    }
}

#[test]
fn malformed_text_is_refused() {
    let of = |text: &[u8]| from_svg(text, TOLERANCE).unwrap_err();
    assert!(matches!(of(b""), SvgError::NotXml { .. }));
    assert!(matches!(of(b"<svg><g></svg>"), SvgError::NotXml { .. }));
    assert_eq!(of(b"<html></html>"), SvgError::NotSvg { root: "html".into() });
    assert!(matches!(of(b"\xff\xfe<\x00s\x00"), SvgError::NotXml { .. }));
    assert_eq!(of(b"abcdefghij\x00klmnopqrst"), SvgError::NotText);
    let flat = r#"<svg xmlns="http://www.w3.org/2000/svg" width="0" height="10"><rect width="1" height="1"/></svg>"#;
    assert_eq!(of(flat.as_bytes()), SvgError::NoSize);
    let long = vec![b' '; policy::SVG_BYTES + 1];
    assert!(matches!(of(&long), SvgError::TooLong { .. }));
}

#[test]
fn a_self_crossing_path_is_refused_and_a_pen_slip_repaired() {
    let bow_tie = read(r#"<path d="M10 10 L90 90 L90 10 L10 90 Z"/>"#).unwrap_err();
    assert_eq!(bow_tie, OutlineError::SelfCrossing { x: 50.0, y: 50.0 }.into());
    let slip = r#"<path d="M10 10 H90 V91 L89.5 91 L90.5 90 H10 Z"/>"#;
    near(area(slip), 6400.0, 1e-3);
}

/// `levels` groups, each using the previous one ten times.
fn laughs(levels: usize) -> String {
    let mut body = String::from(r#"<defs><rect id="l0" width="9" height="9"/>"#);
    for level in 1..=levels {
        let line = format!(r##"<use href="#l{}"/>"##, level - 1).repeat(10);
        body.push_str(&format!(r#"<g id="l{level}">{line}</g>"#));
    }
    body + &format!(r##"</defs><use href="#l{levels}"/>"##)
}

/// What is not counted first would multiply for hours.
fn refused(body: &str) -> SvgError {
    read(body).unwrap_err()
}

#[test]
fn nested_use_is_counted_before_it_is_expanded() {
    near(area(&laughs(2)), 81.0, 1e-6);
    for levels in [6, 9, 40] {
        let error = refused(&laughs(levels));
        assert_eq!(error, SvgError::TooManyElements { limit: policy::SVG_ELEMENTS });
    }
    let chain: String =
        (0..100_000).map(|i| format!(r##"<g id="c{i}"><use href="#c{}"/></g>"##, i + 1)).collect();
    assert!(matches!(refused(&chain), SvgError::TooDeep { .. }));
    let nested =
        format!("{}{}", "<g><use href='#x'>".repeat(500_000), "</use></g>".repeat(500_000));
    assert!(matches!(
        refused(&nested),
        SvgError::TooManyElements { .. } | SvgError::TooDeep { .. }
    ));
    let flat = "<use href='#a'/>".repeat(1_000_000);
    assert!(matches!(refused(&flat), SvgError::TooManyElements { .. } | SvgError::TooLong { .. }));
}

#[test]
fn circles_of_use_and_deep_groups_are_refused() {
    let circle = r##"<g id="a"><use href="#b"/></g><g id="b"><use href="#c"/></g><g id="c"><use href="#a"/></g>"##;
    assert!(matches!(refused(circle), SvgError::Circular { .. }));
    let deep =
        |n: usize| format!("{}<rect width='9' height='9'/>{}", "<g>".repeat(n), "</g>".repeat(n));
    assert!(matches!(refused(&deep(50_000)), SvgError::TooDeep { .. }));
    near(area(&deep(policy::SVG_DEPTH as usize - 2)), 81.0, 1e-6);
}

#[test]
fn entities_markers_and_patterns_cannot_multiply() {
    let mut entities =
        String::from(r#"<!DOCTYPE svg [<!ENTITY e0 "<rect width='9' height='9'/>">"#);
    for i in 1..9 {
        entities += &format!("<!ENTITY e{i} \"{}\">", format!("&e{};", i - 1).repeat(10));
    }
    assert!(from_svg((entities + "]>" + &drawing("&e8;")).as_bytes(), TOLERANCE).is_err());

    let mut markers = String::new();
    let mut patterns = String::new();
    for i in 0..8 {
        let line = format!("M0 0{}", "L1 1L2 0".repeat(20));
        markers += &format!(
            r##"<marker id="m{i}"><path marker-mid="url(#m{0})" style="marker-mid:url(#m{0})" d="{line}"/></marker>"##,
            i + 1
        );
        let tile = format!(r##"<rect fill="url(#p{})" width="1" height="1"/>"##, i + 1).repeat(20);
        patterns += &format!(r#"<pattern id="p{i}" width="1" height="1">{tile}</pattern>"#);
    }
    let body = format!(
        r##"{markers}{patterns}<path marker-mid="url(#m0)" fill="url(#p0)" d="M0 0H9V9H0Z"/>"##
    );
    near(area(&body), 81.0, 1e-6);
}

#[test]
fn coordinates_and_attributes_beyond_reason_are_refused() {
    let far = r#"<path transform="scale(1e12)" d="M0 0H9V9Z"/>"#;
    assert!(matches!(
        read(far).unwrap_err(),
        SvgError::Outline(OutlineError::OutOfRange { .. }) | SvgError::NothingFilled
    ));
    let attributes: String = (0..60_000).map(|i| format!(" a{i}='1'")).collect();
    let error = refused(&format!("<rect width='9' height='9'{attributes}/>"));
    assert!(matches!(error, SvgError::TooManyElements { .. }));
    near(area("<!-- don't count --><rect width='9' height='9'/>"), 81.0, 1e-6);
}
