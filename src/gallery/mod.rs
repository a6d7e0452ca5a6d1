//! Many pairs at once: which pairs there are, what is kept of each, and the tables and the page that show them side by side.
//!
//! Nothing here makes gears or writes files; the command does both, pair by pair, so that a run may stop anywhere.

mod page;
mod row;
mod thumbnail;

pub use page::gallery_html;
pub use row::{Figures, Row, sorted, to_csv, to_json};
pub use thumbnail::Thumbnail;

use crate::fit::Ratio;

/// Names of the files that show all pairs: the tables and the page.
pub const TABLES: [&str; 3] = ["gallery.csv", "gallery.json", "index.html"];

/// Part `part` of `of`, counted from 1.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    part: usize,
    of: usize,
}

impl Shard {
    /// None unless `1 <= part <= of`.
    #[must_use]
    pub fn new(part: usize, of: usize) -> Option<Self> {
        (1..=of).contains(&part).then_some(Self { part, of })
    }

    /// Whether the job at `index` (from 0) belongs to this part. Neighbours go to different parts, and each round begins
    /// one further on, so that no part gets one ratio only.
    #[must_use]
    pub fn has(self, index: usize) -> bool {
        (index + index / self.of) % self.of == self.part - 1
    }
}

/// One pair to make: indices into a list of shapes, and the ratio.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Job {
    /// Index of the driver's shape.
    pub driver: usize,
    /// Index of the follower's.
    pub follower: usize,
    /// Driver turns for one turn of the follower.
    pub ratio: Ratio,
}

impl Job {
    /// Name of the pair's folder; `names` are those of the shapes and all different.
    #[must_use]
    pub fn folder(&self, names: &[String]) -> String {
        let plain = |name: &str| -> String {
            let kept = |c: char| c.is_alphanumeric() || c == '-' || c == '_';
            name.chars().map(|c| if kept(c) { c } else { '_' }).collect()
        };
        let (d, f) = (self.ratio.driver_fold(), self.ratio.follower_fold());
        let ratio = if d == 1 { format!("{f}") } else { format!("{f}over{d}") };
        format!("{}+{}-k{ratio}", plain(&names[self.driver]), plain(&names[self.follower]))
    }
}

/// Every one of `shapes` shapes as driver of itself and of those after it, or of all with `both_roles`, at each
/// ratio; ratios of one pair stand together.
#[must_use]
pub fn all_pairs(shapes: usize, both_roles: bool, ratios: &[Ratio]) -> Vec<Job> {
    let from = |i| if both_roles { 0 } else { i };
    (0..shapes)
        .flat_map(|driver| (from(driver)..shapes).map(move |follower| (driver, follower)))
        .flat_map(|(driver, follower)| {
            ratios.iter().map(move |&ratio| Job { driver, follower, ratio })
        })
        .collect()
}

/// The names, those that occurred before with a number behind them.
#[must_use]
pub fn told_apart(names: &[String]) -> Vec<String> {
    let mut apart: Vec<String> = Vec::with_capacity(names.len());
    for name in names {
        let mut candidate = name.clone();
        let mut number = 2;
        while apart.contains(&candidate) {
            candidate = format!("{name}-{number}");
            number += 1;
        }
        apart.push(candidate);
    }
    apart
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_part_the_work() {
        for of in 1..6 {
            for index in 0..20 {
                let takers = (1..=of).filter(|p| Shard::new(*p, of).unwrap().has(index)).count();
                assert_eq!(takers, 1);
            }
        }
        assert_eq!((Shard::new(0, 3), Shard::new(4, 3), Shard::new(1, 0)), (None, None, None));
    }

    #[test]
    fn pairs_and_their_folders() {
        let ratios = [Ratio::ONE, Ratio::reciprocal(3).unwrap()];
        assert_eq!(all_pairs(24, false, &[Ratio::ONE]).len(), 300, "as many as in the paper");
        assert_eq!(all_pairs(3, true, &ratios).len(), 18);
        let names = told_apart(&["a b".to_owned(), "c".to_owned(), "c".to_owned()]);
        assert_eq!(names, ["a b", "c", "c-2"]);
        let folders: Vec<String> =
            all_pairs(3, false, &ratios).iter().map(|j| j.folder(&names)).collect();
        assert_eq!(folders[..3], ["a_b+a_b-k1", "a_b+a_b-k1over3", "a_b+c-k1"]);
        let mut unique = folders.clone();
        unique.sort();
        unique.dedup();
        assert_eq!(unique.len(), folders.len());
    }
}
