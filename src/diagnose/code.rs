//! The kinds of findings. Their words are kept from version to version.

macro_rules! codes {
    ($($(#[doc = $doc:literal])* $name:ident = $word:literal,)*) => {
        /// A kind of finding. Angles are radians, lengths mm.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, serde::Serialize, serde::Deserialize)]
        #[non_exhaustive]
        pub enum Code {
            $($(#[doc = $doc])* #[serde(rename = $word)] $name,)*
        }

        impl Code {
            /// All of them.
            pub const ALL: &'static [Self] = &[$(Self::$name,)*];

            /// A stable word for programs.
            #[must_use]
            pub fn word(self) -> &'static str {
                match self {
                    $(Self::$name => $word,)*
                }
            }
        }
    };
}

codes! {
    // The wanted motion.
    /// Bounds on slope and torque changed the pitch curves: `shape` in the measure of E_s, slopes `from` and `to`.
    LimitsKept = "limits-kept",
    /// Motion and axes were refined: the measure `before` and `after`, shares.
    Refined = "refined",
    /// The pitch curve of a gear hardly resembles its drawing: `share` of intersection over union.
    PoorLikeness = "poor-likeness",
    /// Areas of a drawing are hidden from the axis and filled in: `share` of its area.
    HiddenArea = "hidden-area",
    // Pitch curves at their size.
    /// Corners too sharp for the teeth were rounded: `shape` in the measure of E_s.
    CornersRounded = "corners-rounded",
    /// A motion was changed so that teeth can follow it: by `angle` of the follower.
    MotionChanged = "motion-changed",
    // Repairs.
    /// Gentler settings were used: bound on the slope `slope`, least radius `radius` in modules; transmission error
    /// `before` and `after`, pitches.
    GentlerTeeth = "gentler-teeth",
    /// The pair was made again with less slope, `slope` at most, for the first one failed its proof.
    LessSlope = "less-slope",
    // Outlines.
    /// Contact of `count` of `teeth` teeth ends before the next one engages; the worst holds `share` of a pitch.
    Undercut = "undercut",
    /// A body is thinner than `thickness` between its roots.
    ThinBody = "thin-body",
    /// An outline crosses itself.
    SelfCrossing = "self-crossing",
    // Contact.
    /// Contact is lost over `angle` of driver turn in all; `exact` is 1 where it is lost without clearance too.
    ContactLost = "contact-lost",
    /// Contact is lost when the load is reversed; `exact` likewise.
    ContactLostBackward = "contact-lost-backward",
    /// The gears never touch; `gap` at every angle, if it is known.
    NoContact = "no-contact",
    /// The outlines overlap by `depth` at the designed pose.
    Overlap = "overlap",
    /// The teeth themselves, without clearance, deviate by `pitches` (99th percentile).
    ToothError = "tooth-error",
    /// Transmission error peak to peak: `angle`, `pitches`, `limit` in pitches.
    TransmissionError = "transmission-error",
    /// The working pressure angle reaches `angle`.
    PressureAngle = "pressure-angle",
    /// The backlash reaches `pitches` of a pitch.
    Backlash = "backlash",
    /// Friction of coefficient `friction` locks the gears, by the contact alone.
    SelfLocking = "self-locking",
    // Runs.
    /// The motor stalled.
    Jam = "jam",
    /// The bodies were flung apart.
    FlungApart = "flung-apart",
    /// The driver loses contact for `pitches` of its pitches; `limit`.
    FreeRun = "free-run",
    /// The gears are pressed `depth` into each other; `limit`.
    Penetration = "penetration",
    /// The follower gained or lost `pitches`.
    SkippedTeeth = "skipped-teeth",
    /// The follower is `angle` from where the flanks touch; `limit`.
    OffContact = "off-contact",
    /// The driver's torque is `loads` loads off its ideal; `limit`.
    Torque = "torque",
    /// Efficiency is `share`; `limit`.
    Efficiency = "efficiency",
    /// The run ended after the greatest number of steps.
    CutShort = "cut-short",
    // Bores, hubs, lettering, base.
    /// The bore is `diameter` wide, for a wider one leaves too thin a wall.
    NarrowBore = "narrow-bore",
    /// There is no room for a bore.
    NoBore = "no-bore",
    /// There is no room for a phase mark.
    NoPhaseMark = "no-phase-mark",
    /// There is no room for lightening holes.
    NoLightening = "no-lightening",
    /// `count` of `of` holes of a drawing, or areas to be cut through, are left whole for want of walls.
    HolesLost = "holes-lost",
    /// There is no room for the inner drawing.
    FaceLost = "face-lost",
    /// A `share` of the inner drawing is left out, for edges, axle or fittings are there.
    FaceClipped = "face-clipped",
    /// `widened` lines of the inner drawing were widened to the `nozzle`, `dropped` specks left out.
    FaceLines = "face-lines",
    /// There is no room for the gear's name.
    NameHasNoRoom = "name-has-no-room",
    /// The gear's name cannot be written with the letters there are.
    NameUnwritable = "name-unwritable",
    // Sectors.
    /// A gear was cut to `teeth` of its `of` teeth, for driver angles `from` and `to`.
    SectorCut = "sector-cut",
    /// A gear needs nearly all of its turn and stays whole.
    SectorWhole = "sector-whole",
    /// The cut gears keep contact at all `poses` poses.
    SectorKeepsContact = "sector-keeps-contact",
    /// The cut gears lose contact or overlap.
    SectorContact = "sector-contact",
}

impl std::fmt::Display for Code {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.word())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_differ_and_are_plain() {
        let words: std::collections::BTreeSet<&str> = Code::ALL.iter().map(|c| c.word()).collect();
        assert_eq!(words.len(), Code::ALL.len());
        assert!(words.iter().all(|w| w.chars().all(|c| c.is_ascii_lowercase() || c == '-')));
    }
}
