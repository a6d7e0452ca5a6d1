//! Lengths and angles as people type them.

use centrode::fit::Ratio;
use centrode::gallery::Shard;
use centrode::geometry::Point;
use centrode::pipeline::outfit::{Base, Hold, LabelPlace, Mount};
use centrode::policy;
use centrode::solid::hardware::{Bearing, Clearance, Screw};
use centrode::solid::{Bore, BoreName, Fit};

/// Studs of the well-known building brick, mm.
const STUD_MM: f64 = 8.0;

/// No printer has a smaller bed, mm.
const LEAST_BED: f64 = 20.0;

/// Finest and coarsest nozzle, mm.
const NOZZLES: (f64, f64) = (0.05, 2.0);

/// A length in mm from `80`, `80mm`, `8cm` or `3in`.
pub(crate) fn length(text: &str) -> Result<f64, String> {
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
pub(crate) fn positive_length(text: &str) -> Result<f64, String> {
    match length(text)? {
        value if value > 0.0 => Ok(value),
        _ => Err(format!("'{text}' is not above zero; give a length such as 80mm")),
    }
}

/// A length of zero or more.
pub(crate) fn length_or_zero(text: &str) -> Result<f64, String> {
    match length(text)? {
        value if value >= 0.0 => Ok(value),
        _ => Err(format!("'{text}' is below zero; give 0 or more, such as 0.1mm")),
    }
}

/// A centre distance: a length, or `lego:N` for N studs of 8 mm.
pub(crate) fn center_distance(text: &str) -> Result<f64, String> {
    let Some(studs) = text.strip_prefix("lego:") else {
        return positive_length(text);
    };
    match studs.parse::<u32>() {
        Ok(count) if count > 0 => Ok(f64::from(count) * STUD_MM),
        _ => Err(format!("'{text}' does not name a number of studs; write it like lego:10")),
    }
}

/// An angle in radians from degrees.
pub(crate) fn degrees(text: &str) -> Result<f64, String> {
    let number = text.trim().trim_end_matches("deg").trim_end_matches('°').trim();
    match number.parse::<f64>() {
        Ok(value) if value.is_finite() => Ok(value.to_radians()),
        _ => Err(format!("'{text}' is not an angle in degrees; write it like 20")),
    }
}

/// A number above zero, of a size that things have.
pub(crate) fn positive(text: &str) -> Result<f64, String> {
    let (least, most) = policy::QUANTITY_RANGE;
    match text.trim().parse::<f64>() {
        Ok(value) if (least..=most).contains(&value) => Ok(value),
        _ => Err(format!("'{text}' is not a number above zero; give {least:e} to {most:e}")),
    }
}

/// Cycles of a run that judges all teeth.
pub(crate) fn whole_cycles(text: &str) -> Result<f64, String> {
    cycles(text).ok().filter(|count| *count >= 1.0).ok_or_else(|| {
        format!(
            "'{text}' is no number of whole cycles; give 1 to {}, less does not turn all teeth through the mesh",
            policy::MOST_CYCLES
        )
    })
}

/// Cycles of a run, also a part of one.
pub(crate) fn cycles(text: &str) -> Result<f64, String> {
    let most = policy::MOST_CYCLES;
    positive(text)
        .ok()
        .filter(|count| *count <= most)
        .ok_or_else(|| format!("'{text}' is no number of cycles; give up to {most}, such as 2"))
}

/// A ratio above zero: a number or a fraction such as 1/2.
pub(crate) fn ratio(text: &str) -> Result<f64, String> {
    let failed = || format!("'{text}' is not a ratio above zero; write it like 2 or 1/2");
    let (over, under) = text.split_once('/').unwrap_or((text, "1"));
    match (positive(over), positive(under)) {
        (Ok(over), Ok(under)) if (over / under).is_finite() => Ok(over / under),
        _ => Err(failed()),
    }
}

/// A ratio in whole turns: `2`, `1/3`, `3:2`, `3/2`.
pub(crate) fn turns(text: &str) -> Result<Ratio, String> {
    let (driver, follower) =
        text.split_once(':').or_else(|| text.split_once('/')).unwrap_or((text, "1"));
    let count = |part: &str| part.trim().parse::<u32>().ok();
    let made = count(driver).zip(count(follower)).and_then(|(m, n)| Ratio::rational(m, n).ok());
    made.ok_or_else(|| {
        format!(
            "'{text}' is not a ratio of whole turns up to {}; write it like 2, 1/3 or 3:2",
            centrode::policy::MAX_RATIO
        )
    })
}

/// A point in mm from `x,y`.
pub(crate) fn point(text: &str) -> Result<Point, String> {
    let failed = || format!("'{text}' is not a point; write it like 12.5,-3");
    let (x, y) = text.split_once(',').ok_or_else(failed)?;
    match (x.trim().parse::<f64>(), y.trim().parse::<f64>()) {
        (Ok(x), Ok(y)) if x.is_finite() && y.is_finite() => Ok(Point::new(x, y)),
        _ => Err(failed()),
    }
}

/// Two tooth counts from `N,M`.
pub(crate) fn two_counts(text: &str) -> Result<[u32; 2], String> {
    let (least, most) = (1, centrode::policy::COUNT_RANGE.1);
    let count = |t: &str| t.trim().parse().ok().filter(|n| (least..=most).contains(&(*n as usize)));
    let both = text.split_once(',').and_then(|(n, m)| count(n).zip(count(m)));
    both.map(|(n, m): (u32, u32)| [n, m]).ok_or_else(|| {
        format!("'{text}' are not two tooth counts from {least} to {most}; write them like 32,48")
    })
}

/// Density of a named material, kg/m^3.
pub(crate) fn material(text: &str) -> Result<f64, String> {
    let wanted = text.trim().to_ascii_lowercase();
    let table = centrode::policy::DENSITIES;
    table.iter().find(|(name, _)| *name == wanted).map(|(_, density)| *density).ok_or_else(|| {
        let names: Vec<&str> = table.iter().map(|(name, _)| *name).collect();
        format!("there is no material {text:?}; choose from {} or give --density", names.join(", "))
    })
}

/// A number of zero or more.
pub(crate) fn zero_or_more(text: &str) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(value) if value.is_finite() && value >= 0.0 => Ok(value),
        _ => Err(format!("'{text}' is not a number of zero or more")),
    }
}

/// A number from 0 to 1.
pub(crate) fn fraction(text: &str) -> Result<f64, String> {
    match zero_or_more(text)? {
        value if value <= 1.0 => Ok(value),
        _ => Err(format!("'{text}' is not between 0 and 1")),
    }
}

/// A part of the work from `I/N`.
pub(crate) fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text.split_once('/').and_then(|(i, n)| {
        Some((i.trim().parse::<usize>().ok()?, n.trim().parse::<usize>().ok()?))
    });
    numbers.and_then(|(part, of)| Shard::new(part, of)).ok_or_else(|| {
        format!("'{text}' is no part of the work; write it like 2/8: the second of eight")
    })
}

/// A bore: what goes through by its name (`M5`, `608`, `nema17`), `none`, `lego`, the diameter of a round hole, or a kind
/// with sizes such as `d:5x4.5`.
pub(crate) fn bore(text: &str) -> Result<BoreArg, String> {
    let refused = || {
        format!(
            "'{text}' is not a bore; write {}, none, lego, 5mm, round:5, d:5, d:5x4.5, hex:6, square:4, keyway:8 or keyway:8x2x1",
            BoreName::all().join(", ")
        )
    };
    if let Ok(name) = text.parse() {
        return Ok(BoreArg::Named(name));
    }
    match text {
        "none" => return Ok(BoreArg::Sized(Bore::None)),
        "lego" => return Ok(BoreArg::Sized(Bore::Lego { play: policy::LEGO_AXLE_PLAY })),
        _ => {}
    }
    let (kind, sizes) = text.split_once(':').unwrap_or(("round", text));
    let sizes: Vec<f64> = sizes
        .split('x')
        .map(|size| positive_length(size).map_err(|_| refused()))
        .collect::<Result<_, _>>()?;
    Ok(BoreArg::Sized(match (kind, sizes.as_slice()) {
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

/// What the gears stand on: `none`, `pins`, `lego`, a screw, or a bearing.
pub(crate) fn base(text: &str) -> Result<Base, String> {
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

/// A nozzle, mm.
pub(crate) fn nozzle(text: &str) -> Result<f64, String> {
    let (least, most) = NOZZLES;
    match positive_length(text)? {
        value if (least..=most).contains(&value) => Ok(value),
        _ => Err(format!("'{text}' is no nozzle; give {least}mm to {most}mm")),
    }
}

/// Where letters go.
pub(crate) fn label_place(text: &str) -> Result<LabelPlace, String> {
    let found = LabelPlace::ALL.into_iter().find(|(name, _)| *name == text);
    found.map(|(_, place)| place).ok_or_else(|| {
        format!("'{text}' is no place for letters; write axis, above, below, left or right")
    })
}

/// What a base is held by: a screw, or `feet`.
pub(crate) fn mount(text: &str) -> Result<Mount, String> {
    if text == "feet" {
        return Ok(Mount::Feet);
    }
    Screw::named(text)
        .map(Mount::Screws)
        .ok_or_else(|| format!("'{text}' holds no base; write a screw such as M4, or feet"))
}

/// The bed of a printer, `WIDTHxDEPTH`, mm.
pub(crate) fn bed(text: &str) -> Result<[f64; 2], String> {
    let sides = text.split_once(['x', 'X', '*']);
    let side = |t: &str| positive_length(t).ok().filter(|side| *side > LEAST_BED);
    sides.and_then(|(w, d)| Some([side(w)?, side(d)?])).ok_or_else(|| {
        format!("'{text}' is not the size of a bed; write it like 220x220, or 250x210mm")
    })
}

/// What `--bore` names.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum BoreArg {
    /// What goes through; the fit is added by its kind.
    Named(BoreName),
    /// A hole by its sizes.
    Sized(Bore),
}

/// A fit: a name or play a side.
pub(crate) fn fit(text: &str) -> Result<Fit, String> {
    match text {
        "tight" => return Ok(Fit::Play(policy::TIGHT_FIT)),
        "slide" => return Ok(Fit::Play(policy::SLIDE_FIT)),
        "loose" => return Ok(Fit::Play(policy::LOOSE_FIT)),
        _ => {}
    }
    if let Some((_, class)) = Clearance::ALL.into_iter().find(|(name, _)| *name == text) {
        return Ok(Fit::Clearance(class));
    }
    length_or_zero(text).map(Fit::Play).map_err(|_| {
        format!(
            "'{text}' is not a fit; write tight, slide, loose, a length such as 0.1mm, or for screws fine, medium, coarse"
        )
    })
}

/// A kerf that a cutter may have, mm.
pub(crate) fn kerf(text: &str) -> Result<f64, String> {
    let most = policy::LARGEST_KERF;
    match length_or_zero(text)? {
        value if value <= most => Ok(value),
        _ => Err(format!("'{text}' is wider than any cutter's; give 0mm to {most}mm")),
    }
}

/// A distance that curves in files may keep from the outline, mm.
pub(crate) fn curve_tolerance(text: &str) -> Result<f64, String> {
    let (least, most) = (policy::LEAST_EXPORT_TOLERANCE, policy::LARGEST_EXPORT_TOLERANCE);
    match positive_length(text)? {
        value if (least..=most).contains(&value) => Ok(value),
        _ => Err(format!("'{text}' is no tolerance that fits gears; give {least}mm to {most}mm")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
        assert_eq!(bore("none"), Ok(BoreArg::Sized(Bore::None)));
        assert_eq!(bore("5mm"), Ok(BoreArg::Sized(Bore::Round { diameter: 5.0 })));
        assert_eq!(bore("round:5"), bore("5"));
        assert_eq!(bore("d:5"), bore("d:5x4.5mm"));
        assert_eq!(bore("hex:6mm"), Ok(BoreArg::Sized(Bore::Hex { across: 6.0 })));
        assert_eq!(bore("square:4"), Ok(BoreArg::Sized(Bore::Square { side: 4.0 })));
        assert_eq!(bore("keyway:8"), bore("keyway:8x2x1"));
        for name in ["M5", "m2.5", "608", "608ZZ", "nema17"] {
            assert!(matches!(bore(name), Ok(BoreArg::Named(_))), "{name}");
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
        assert_eq!(bed("250x210mm"), Ok([250.0, 210.0]));
        assert!(base("bolt:M5").is_err() && mount("glue").is_err());
        assert!(bed("220").is_err() && bed("0x200").is_err() && bed("1x1").is_err());
    }

    #[test]
    fn fits_by_name_or_length() {
        assert_eq!(fit("slide"), Ok(Fit::Play(0.15)));
        assert_eq!(fit("0.2mm"), Ok(Fit::Play(0.2)));
        assert_eq!(fit("medium"), Ok(Fit::Clearance(Clearance::Medium)));
        assert!(fit("snug").is_err() && fit("-0.1").is_err());
    }
}
