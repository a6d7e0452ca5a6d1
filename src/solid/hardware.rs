//! What makers buy for their gears: screws, nuts, threaded inserts, ball bearings, motors. Sizes in mm.

/// A metric screw and what goes with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Screw {
    /// Its name, such as `M5`.
    pub name: &'static str,
    /// Diameter of the thread.
    pub diameter: f64,
    /// Diameters of clearance holes by ISO 273: fine, medium, coarse.
    pub clearance: [f64; 3],
    /// Hexagon nut by ISO 4032 and head by ISO 4017: width across flats.
    pub across_flats: f64,
    /// Greatest height of that nut.
    pub nut_height: f64,
    /// Hole for a threaded insert that is melted in, and its least depth: makers' data sheets.
    pub insert: Option<[f64; 2]>,
}

/// Screws M2 to M12.
pub const SCREWS: [Screw; 9] = [
    screw("M2", 2.0, [2.2, 2.4, 2.6], 4.0, 1.6, Some([3.2, 4.5])),
    screw("M2.5", 2.5, [2.7, 2.9, 3.1], 5.0, 2.0, Some([4.0, 6.2])),
    screw("M3", 3.0, [3.2, 3.4, 3.6], 5.5, 2.4, Some([4.0, 6.2])),
    screw("M4", 4.0, [4.3, 4.5, 4.8], 7.0, 3.2, Some([5.6, 8.6])),
    screw("M5", 5.0, [5.3, 5.5, 5.8], 8.0, 4.7, Some([6.4, 10.0])),
    screw("M6", 6.0, [6.4, 6.6, 7.0], 10.0, 5.2, Some([8.0, 13.2])),
    screw("M8", 8.0, [8.4, 9.0, 10.0], 13.0, 6.8, Some([9.7, 13.2])),
    screw("M10", 10.0, [10.5, 11.0, 12.0], 16.0, 8.4, None),
    screw("M12", 12.0, [13.0, 13.5, 14.5], 18.0, 10.8, None),
];

const fn screw(
    name: &'static str,
    diameter: f64,
    clearance: [f64; 3],
    across_flats: f64,
    nut_height: f64,
    insert: Option<[f64; 2]>,
) -> Screw {
    Screw { name, diameter, clearance, across_flats, nut_height, insert }
}

impl Screw {
    /// The screw of a name such as `M5` or `m2.5`.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        SCREWS.into_iter().find(|s| s.name.eq_ignore_ascii_case(name.trim()))
    }

    /// Diameter of its clearance hole.
    #[must_use]
    pub fn hole(&self, class: Clearance) -> f64 {
        self.clearance[class as usize]
    }
}

/// Classes of clearance holes by ISO 273.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Clearance {
    /// For what must keep its place.
    #[default]
    Fine,
    /// For ordinary work.
    Medium,
    /// For rough work.
    Coarse,
}

impl Clearance {
    /// All, by their names.
    pub const ALL: [(&'static str, Self); 3] =
        [("fine", Self::Fine), ("medium", Self::Medium), ("coarse", Self::Coarse)];

    /// Its name in the standard.
    #[must_use]
    pub fn name(self) -> &'static str {
        Self::ALL[self as usize].0
    }
}

/// A deep-groove ball bearing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bearing {
    /// Its number, such as `608`.
    pub name: &'static str,
    /// Diameter of the shaft.
    pub shaft: f64,
    /// Outside diameter.
    pub outside: f64,
    /// Width.
    pub width: f64,
}

/// Bearings that toys and printers are built with; boundary dimensions by ISO 15, shielded.
pub const BEARINGS: [Bearing; 12] = [
    bearing("623", 3.0, 10.0, 4.0),
    bearing("624", 4.0, 13.0, 5.0),
    bearing("625", 5.0, 16.0, 5.0),
    bearing("626", 6.0, 19.0, 6.0),
    bearing("608", 8.0, 22.0, 7.0),
    bearing("688", 8.0, 16.0, 5.0),
    bearing("698", 8.0, 19.0, 6.0),
    bearing("6800", 10.0, 19.0, 5.0),
    bearing("6900", 10.0, 22.0, 6.0),
    bearing("6000", 10.0, 26.0, 8.0),
    bearing("6001", 12.0, 28.0, 8.0),
    bearing("6801", 12.0, 21.0, 5.0),
];

const fn bearing(name: &'static str, shaft: f64, outside: f64, width: f64) -> Bearing {
    Bearing { name, shaft, outside, width }
}

impl Bearing {
    /// The bearing of a number; seals and shields after it (`608ZZ`, `608-2RS`) change nothing.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let name = name.trim().to_ascii_uppercase();
        let plain =
            ["-2RS", "2RS", "-2Z", "-ZZ", "ZZ", "2Z"].iter().find_map(|s| name.strip_suffix(s));
        let plain = plain.unwrap_or(&name);
        BEARINGS.into_iter().find(|b| b.name == plain)
    }
}

/// A motor's shaft: round with one flat.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// Its name, such as `nema17`.
    pub name: &'static str,
    /// Diameter of the shaft.
    pub shaft: f64,
    /// From its flat to the far side.
    pub flat: f64,
}

/// Stepping motors by the size of their flange; the usual shaft of each.
pub const MOTORS: [Motor; 3] = [
    Motor { name: "nema11", shaft: 5.0, flat: 4.5 },
    Motor { name: "nema14", shaft: 5.0, flat: 4.5 },
    Motor { name: "nema17", shaft: 5.0, flat: 4.5 },
];

impl Motor {
    /// The motor of a name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        let name = name.trim().to_ascii_lowercase().replace([' ', '-'], "");
        MOTORS.into_iter().find(|m| m.name == name)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_size_leaves_room_for_what_goes_in() {
        for s in SCREWS {
            assert!(s.clearance.windows(2).all(|c| c[0] < c[1]) && s.clearance[0] > s.diameter);
            assert!(s.across_flats > 1.4 * s.diameter && s.nut_height < s.across_flats);
            assert!(s.insert.is_none_or(|[hole, deep]| hole > s.diameter && deep > hole));
            assert_eq!(Screw::named(&s.name.to_lowercase()), Some(s));
        }
        for b in BEARINGS {
            assert!(b.outside > b.shaft + 5.0 && b.width < b.outside);
        }
        assert_eq!(Bearing::named("608-2rs"), Bearing::named("608"));
        assert_eq!(Motor::named("NEMA 17").map(|m| m.shaft), Some(5.0));
        assert!(Screw::named("M7").is_none() && Bearing::named("609").is_none());
    }
}
