//! What only the command line takes as text; lengths, angles, bores and the like are read by [`centrode::schema::words`].

use centrode::gallery::Shard;
use centrode::policy;
pub(crate) use centrode::schema::words::{
    base, bore, center_distance, degrees, fit, label_place, length_or_zero, lightening, material,
    mount, point, positive_length, turns,
};

/// No printer has a smaller bed, mm.
const LEAST_BED: f64 = 20.0;

/// Finest and coarsest nozzle, mm.
const NOZZLES: (f64, f64) = (0.05, 2.0);

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

/// Two tooth counts from `N,M`.
pub(crate) fn two_counts(text: &str) -> Result<[u32; 2], String> {
    let (least, most) = (1, centrode::policy::COUNT_RANGE.1);
    let count = |t: &str| t.trim().parse().ok().filter(|n| (least..=most).contains(&(*n as usize)));
    let both = text.split_once(',').and_then(|(n, m)| count(n).zip(count(m)));
    both.map(|(n, m): (u32, u32)| [n, m]).ok_or_else(|| {
        format!("'{text}' are not two tooth counts from {least} to {most}; write them like 32,48")
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

/// A nozzle, mm.
pub(crate) fn nozzle(text: &str) -> Result<f64, String> {
    let (least, most) = NOZZLES;
    match positive_length(text)? {
        value if (least..=most).contains(&value) => Ok(value),
        _ => Err(format!("'{text}' is no nozzle; give {least}mm to {most}mm")),
    }
}

/// The bed of a printer, `WIDTHxDEPTH`, mm.
pub(crate) fn bed(text: &str) -> Result<[f64; 2], String> {
    let sides = text.split_once(['x', 'X', '*']);
    let side = |t: &str| positive_length(t).ok().filter(|side| *side > LEAST_BED);
    sides.and_then(|(w, d)| Some([side(w)?, side(d)?])).ok_or_else(|| {
        format!("'{text}' is not the size of a bed; write it like 220x220, or 250x210mm")
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
    fn beds_hold_a_gear() {
        assert_eq!(bed("250x210mm"), Ok([250.0, 210.0]));
        assert!(bed("220").is_err() && bed("0x200").is_err() && bed("1x1").is_err());
    }
}
