//! Lengths, angles, bores and fits as people write them: on the command line, in scenes, in records, in Python.

use crate::fit::Ratio;
use crate::geometry::Point;
use crate::pipeline::BoreChoice;
use crate::pipeline::outfit::{Base, Hold, LabelPlace, LabelText, Lightening, Mount};
use crate::policy;
use crate::solid::hardware::{Bearing, Clearance, Screw};
use crate::solid::{Bore, BoreName, Fit};

/// Studs of the well-known building brick, mm.
const STUD_MM: f64 = 8.0;

/// A length in mm from `80`, `80mm`, `8cm` or `3in`.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn length(text: &str) -> Result<f64, String> {
    let text = text.trim();
    let units = [("mm", 1.0), ("cm", 10.0), ("in", 25.4), ("\"", 25.4), ("m", 1000.0)];
    let (number, scale) = units
        .iter()
        .find_map(|(unit, scale)| text.strip_suffix(unit).map(|rest| (rest.trim(), *scale)))
        .unwrap_or((text, 1.0));
    let value: f64 = number
        .parse()
        .map_err(|_| format!("'{text}' is not a length; write it like 80mm, 8cm or 3in"))?;
    if value.is_finite() {
        Ok(value * scale)
    } else {
        Err(format!("'{text}' is not a finite length; write it like 80mm"))
    }
}

/// A length above zero.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn positive_length(text: &str) -> Result<f64, String> {
    match length(text)? {
        value if value > 0.0 => Ok(value),
        _ => Err(format!("'{text}' is not above zero; give a length such as 80mm")),
    }
}

/// A length of zero or more.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn length_or_zero(text: &str) -> Result<f64, String> {
    match length(text)? {
        value if value >= 0.0 => Ok(value),
        _ => Err(format!("'{text}' is below zero; give 0 or more, such as 0.1mm")),
    }
}

/// A centre distance: a length, or `lego:N` for N studs of 8 mm.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn center_distance(text: &str) -> Result<f64, String> {
    let Some(studs) = text.strip_prefix("lego:") else {
        return positive_length(text);
    };
    match studs.parse::<u32>() {
        Ok(count) if count > 0 => Ok(f64::from(count) * STUD_MM),
        _ => Err(format!("'{text}' does not name a number of studs; write it like lego:10")),
    }
}

/// An angle in radians from degrees, such as `20`, `20deg` or `20°`.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn degrees(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches("deg").trim_end_matches('°').trim();
    match number.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value.to_radians()),
        _ => Err(format!("'{text}' is not an angle in degrees; write it like 20")),
    }
}

/// An angle (radians) as [`degrees`] reads it, to a billionth of a degree.
#[must_use]
pub fn in_degrees(angle: f64) -> f64 {
    (angle.to_degrees() * 1e9).round() / 1e9
}

/// A point in mm from `x,y`.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn point(text: &str) -> Result<Point, String> {
    let failed = || format!("'{text}' is not a point; write it like 12.5,-3");
    let (x, y) = text.split_once(',').ok_or_else(failed)?;
    match (x.trim().parse::<f64>(), y.trim().parse::<f64>()) {
        (Ok(x), Ok(y)) if x.is_finite() && y.is_finite() => Ok(Point::new(x, y)),
        _ => Err(failed()),
    }
}

/// A ratio in whole turns: `2`, `1/3`, `3:2`, `3/2`.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn turns(text: &str) -> Result<Ratio, String> {
    let (driver, follower) =
        text.split_once(':').or_else(|| text.split_once('/')).unwrap_or((text, "1"));
    let count = |part: &str| part.trim().parse::<u32>().ok();
    let made = count(driver).zip(count(follower)).and_then(|(m, n)| Ratio::rational(m, n).ok());
    made.ok_or_else(|| {
        format!(
            "'{text}' is not a ratio of whole turns up to {}; write it like 2, 1/3 or 3:2",
            policy::MAX_RATIO
        )
    })
}

/// A bore: what goes through by its name (`M5`, `608`, `nema17`), `none`, `lego`, the diameter of a round hole, or a kind
/// with sizes such as `d:5x4.5`.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn bore(text: &str) -> Result<BoreChoice, String> {
    let refused = || {
        format!(
            "'{text}' is not a bore; write {}, none, lego, 5mm, round:5, d:5, d:5x4.5, hex:6, square:4, keyway:8 or keyway:8x2x1",
            BoreName::all().join(", ")
        )
    };
    if let Ok(name) = text.parse() {
        return Ok(BoreChoice::Named(name));
    }
    match text {
        "none" => return Ok(BoreChoice::Exactly(Bore::None)),
        "lego" => return Ok(BoreChoice::Exactly(Bore::Lego { play: policy::LEGO_AXLE_PLAY })),
        _ => {}
    }
    let (kind, sizes) = text.split_once(':').unwrap_or(("round", text));
    let sizes: Vec<f64> = sizes
        .split('x')
        .map(|size| positive_length(size).map_err(|_| refused()))
        .collect::<Result<_, _>>()?;
    Ok(BoreChoice::Exactly(match (kind, sizes.as_slice()) {
        ("round", &[diameter]) => Bore::Round { diameter },
        ("d", &[diameter]) => Bore::D { diameter, flat: policy::D_FLAT * diameter },
        ("d", &[diameter, flat]) => Bore::D { diameter, flat },
        ("hex", &[across]) => Bore::Hex { across },
        ("square", &[side]) => Bore::Square { side },
        ("keyway", &[diameter]) => Bore::with_standard_key(diameter).ok_or_else(|| {
            format!("DIN 6885 has no key for a shaft of {diameter} mm; give width and depth too, such as keyway:{diameter}x2x1")
        })?,
        ("keyway", &[diameter, width, depth]) => Bore::Keyway { diameter, width, depth },
        _ => return Err(refused()),
    }))
}

/// A bore as [`bore`] reads it; none for the default, which is as wide as there is room for.
#[must_use]
pub fn bore_text(bore: &BoreChoice) -> Option<String> {
    Some(match *bore {
        BoreChoice::AtMost(_) => return None,
        BoreChoice::Named(name) => name.to_string(),
        BoreChoice::Exactly(bore) => match bore {
            Bore::None => "none".to_owned(),
            Bore::Round { diameter } => format!("round:{diameter}"),
            Bore::D { diameter, flat } => format!("d:{diameter}x{flat}"),
            Bore::Hex { across } => format!("hex:{across}"),
            Bore::Square { side } => format!("square:{side}"),
            Bore::Keyway { diameter, width, depth } => {
                format!("keyway:{diameter}x{width}x{depth}")
            }
            Bore::Lego { .. } => "lego".to_owned(),
        },
    })
}

/// A fit: a name, or play a side as a length.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn fit(text: &str) -> Result<Fit, String> {
    match text {
        "tight" => return Ok(Fit::Play(policy::TIGHT_FIT)),
        "slide" => return Ok(Fit::Play(policy::SLIDE_FIT)),
        "loose" => return Ok(Fit::Play(policy::LOOSE_FIT)),
        _ => {}
    }
    if let Some((_, class)) = Clearance::ALL.into_iter().find(|(name, _)| *name == text) {
        return Ok(Fit::Clearance(class));
    }
    length(text).ok().filter(|play| *play >= 0.0).map(Fit::Play).ok_or_else(|| {
        format!(
            "'{text}' is not a fit; write tight, slide, loose, a length such as 0.1mm, or for screws fine, medium, coarse"
        )
    })
}

/// A fit as [`fit`] reads it.
#[must_use]
pub fn fit_text(fit: Fit) -> String {
    match fit {
        Fit::Play(play) => play.to_string(),
        Fit::Clearance(class) => class.name().to_owned(),
    }
}

/// A base as [`base`] reads it.
#[must_use]
pub fn base_text(base: Base) -> String {
    match base {
        Base::None => "none".to_owned(),
        Base::Pins => "pins".to_owned(),
        Base::Lego => "lego".to_owned(),
        Base::Bearing(bearing) => bearing.name.to_owned(),
        Base::Screw { screw, hold } => match hold {
            Hold::Through => screw.name.to_owned(),
            Hold::Nut => format!("nut:{}", screw.name),
            Hold::Insert => format!("insert:{}", screw.name),
        },
    }
}

/// A mount as [`mount`] reads it; none where nothing holds the base.
#[must_use]
pub fn mount_text(mount: Mount) -> Option<String> {
    match mount {
        Mount::None => None,
        Mount::Feet => Some("feet".to_owned()),
        Mount::Screws(screw) => Some(screw.name.to_owned()),
    }
}

/// A place as [`label_place`] reads it.
#[must_use]
pub fn label_place_text(place: LabelPlace) -> &'static str {
    LabelPlace::ALL.into_iter().find(|(_, p)| *p == place).map_or("axis", |(name, _)| name)
}

/// Lettering from its text: nothing for the names of the shapes, one text for both gears, or one for each with a comma
/// between.
#[must_use]
pub fn written(text: &str) -> LabelText {
    match text.split_once(',') {
        _ if text.is_empty() => LabelText::Names,
        Some((driver, follower)) => {
            LabelText::Each([driver, follower].map(|t| t.trim().to_owned()).to_vec())
        }
        None => LabelText::Same(text.to_owned()),
    }
}

/// Lettering as [`written`] reads it.
#[must_use]
pub fn written_text(text: &LabelText) -> String {
    match text {
        LabelText::Names => String::new(),
        LabelText::Same(text) => text.clone(),
        LabelText::Each(texts) => texts.join(","),
    }
}

/// Lightening holes: their number, `auto`, or `none`.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn lightening(text: &str) -> Result<Lightening, String> {
    match text {
        "auto" => Ok(Lightening::Auto),
        "none" => Ok(Lightening::None),
        _ => text.parse().map(Lightening::Holes).map_err(|_| {
            format!("'{text}' is not a number of holes; write one such as 5, or auto")
        }),
    }
}

/// What the gears stand on: `none`, `pins`, `lego`, a screw, or a bearing.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn base(text: &str) -> Result<Base, String> {
    match text {
        "none" => return Ok(Base::None),
        "pins" => return Ok(Base::Pins),
        "lego" => return Ok(Base::Lego),
        _ => {}
    }
    if let Some(bearing) = Bearing::named(text) {
        return Ok(Base::Bearing(bearing));
    }
    let (hold, name) = match text.split_once(':') {
        Some(("nut", name)) => (Hold::Nut, name),
        Some(("insert", name)) => (Hold::Insert, name),
        _ => (Hold::Through, text),
    };
    Screw::named(name).map(|screw| Base::Screw { screw, hold }).ok_or_else(|| {
        format!(
            "'{text}' is no base; write none, pins, lego, a screw such as M5, nut:M5 or insert:M5, or a bearing such as 608"
        )
    })
}

/// Where letters go.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn label_place(text: &str) -> Result<LabelPlace, String> {
    let found = LabelPlace::ALL.into_iter().find(|(name, _)| *name == text);
    found.map(|(_, place)| place).ok_or_else(|| {
        format!("'{text}' is no place for letters; write axis, above, below, left or right")
    })
}

/// What a base is held by: a screw, or `feet`.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn mount(text: &str) -> Result<Mount, String> {
    if text == "feet" {
        return Ok(Mount::Feet);
    }
    Screw::named(text)
        .map(Mount::Screws)
        .ok_or_else(|| format!("'{text}' holds no base; write a screw such as M4, or feet"))
}

/// Density of a named material, kg/m^3.
///
/// # Errors
/// What is wrong, and what would be accepted.
pub fn material(text: &str) -> Result<f64, String> {
    let wanted = text.trim().to_ascii_lowercase();
    let table = policy::DENSITIES;
    table.iter().find(|(name, _)| *name == wanted).map(|(_, density)| *density).ok_or_else(|| {
        let names: Vec<&str> = table.iter().map(|(name, _)| *name).collect();
        format!("there is no material {text:?}; choose from {} or give --density", names.join(", "))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bores_and_fits_read_back() {
        for text in [
            "none",
            "round:5",
            "d:5x4.5",
            "hex:6",
            "square:4",
            "keyway:8x2x1",
            "lego",
            "M5",
            "608",
            "nema17",
        ] {
            assert_eq!(bore_text(&bore(text).unwrap()).as_deref(), Some(text));
        }
        for text in ["0.1", "fine", "coarse"] {
            assert_eq!(fit_text(fit(text).unwrap()), text);
        }
        assert_eq!(fit("tight"), fit(&fit_text(fit("tight").unwrap())));
    }

    #[test]
    fn bases_read_back() {
        for text in ["none", "pins", "lego", "M5", "nut:M5", "insert:M3", "608"] {
            assert_eq!(base_text(base(text).unwrap()), text);
        }
        assert_eq!(mount_text(mount("M4").unwrap()).as_deref(), Some("M4"));
        assert_eq!(mount_text(mount("feet").unwrap()).as_deref(), Some("feet"));
        for text in ["", "both", "one,other"] {
            assert_eq!(written_text(&written(text)), text);
        }
    }

    #[test]
    fn whole_degrees_stay_whole() {
        for whole in [0.0, 20.0, 25.0, 55.0, 359.0] {
            assert_eq!(in_degrees(f64::to_radians(whole)), whole);
        }
    }

    #[test]
    fn lengths_in_several_units() {
        assert_eq!(length("80mm"), Ok(80.0));
        assert_eq!(length(" 8 cm"), Ok(80.0));
        assert_eq!(length("80"), Ok(80.0));
        assert!((length("3in").unwrap_or(0.0) - 76.2).abs() < 1e-12);
        assert_eq!(center_distance("lego:10"), Ok(80.0));
        assert!(positive_length("0").is_err() && positive_length("-3mm").is_err());
        assert!(length("nan").is_err() && length("abc").is_err());
        assert!(center_distance("lego:0").is_err() && center_distance("lego:x").is_err());
    }

    #[test]
    fn turns_of_both_gears() {
        assert_eq!(turns("3:2"), Ok(Ratio::rational(3, 2).unwrap()));
        assert_eq!(turns("6/4"), turns("3:2"));
        assert_eq!(
            (turns("2"), turns("1/3")),
            (
                Ratio::integer(2).map_err(|_| String::new()),
                Ratio::reciprocal(3).map_err(|_| String::new())
            )
        );
        for text in ["0", "1.5", "3:0", "-2", "", "1000:1", "a:b"] {
            assert!(turns(text).unwrap_err().contains("3:2"), "{text}");
        }
    }

    #[test]
    fn bores_by_name_or_diameter() {
        assert_eq!(bore("none"), Ok(BoreChoice::Exactly(Bore::None)));
        assert_eq!(bore("5mm"), Ok(BoreChoice::Exactly(Bore::Round { diameter: 5.0 })));
        assert_eq!(bore("round:5"), bore("5"));
        assert_eq!(bore("d:5"), bore("d:5x4.5mm"));
        assert_eq!(bore("hex:6mm"), Ok(BoreChoice::Exactly(Bore::Hex { across: 6.0 })));
        assert_eq!(bore("square:4"), Ok(BoreChoice::Exactly(Bore::Square { side: 4.0 })));
        assert_eq!(bore("keyway:8"), bore("keyway:8x2x1"));
        for name in ["M5", "m2.5", "608", "608ZZ", "nema17"] {
            assert!(matches!(bore(name), Ok(BoreChoice::Named(_))), "{name}");
        }
        for bad in
            ["wide", "d:5x4x3", "hex:", "oval:4", "keyway:3", "square:-4", "keyway:8x2", "M7"]
        {
            assert!(bore(bad).is_err(), "{bad}");
        }
    }

    #[test]
    fn bases_by_what_gears_turn_on() {
        let m5 = Screw::named("M5").unwrap();
        assert_eq!(base("nut:M5"), Ok(Base::Screw { screw: m5, hold: Hold::Nut }));
        assert_eq!(base("m5"), Ok(Base::Screw { screw: m5, hold: Hold::Through }));
        assert!(matches!(base("608"), Ok(Base::Bearing(_))));
        assert_eq!(mount("feet"), Ok(Mount::Feet));
        assert!(base("bolt:M5").is_err() && mount("glue").is_err());
    }

    #[test]
    fn fits_by_name_or_length() {
        assert_eq!(fit("slide"), Ok(Fit::Play(0.15)));
        assert_eq!(fit("0.2mm"), Ok(Fit::Play(0.2)));
        assert_eq!(fit("medium"), Ok(Fit::Clearance(Clearance::Medium)));
        assert!(fit("snug").is_err() && fit("-0.1").is_err());
    }
}
