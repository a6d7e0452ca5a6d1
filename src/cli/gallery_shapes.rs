//! The shapes of a gallery: folders, drawings, names and lists, read once each.

use std::path::{Path, PathBuf};

use anyhow::{Context, bail};
use centrode::fit::Ratio;
use centrode::input::{LoadOptions, Shape, load};
use centrode::outline::library;
use rayon::prelude::*;

use centrode::gallery::TABLES;

/// Endings of files that are taken for drawings in a folder.
const DRAWINGS: [&str; 10] =
    ["svg", "png", "jpg", "jpeg", "tif", "tiff", "bmp", "csv", "txt", "json"];

/// The word for all built-in shapes.
const ALL: &str = "all";

/// Shapes that could be read, and what could not.
pub(crate) struct Gathered {
    pub(crate) shapes: Vec<Shape>,
    pub(crate) listed: Option<Listed>,
    pub(crate) complaints: Vec<String>,
    /// Every file that was read, or could not be, and names of built-in shapes.
    pub(crate) sources: Vec<String>,
}

/// Pairs of a list; their shapes come after all others.
pub(crate) struct Listed {
    pub(crate) first_shape: usize,
    pub(crate) pairs: Vec<ListedPair>,
}

/// One line of a list.
pub(crate) struct ListedPair {
    pub(crate) driver: usize,
    pub(crate) follower: usize,
    pub(crate) ratio: Option<Ratio>,
}

/// Reads every shape of `from` and of the list.
pub(crate) fn gather(
    from: &[&str],
    list: Option<&Path>,
    options: &LoadOptions,
) -> anyhow::Result<Gathered> {
    if from.is_empty() && list.is_none() {
        bail!(
            "no shapes are named; give folders, drawings or names, such as `centrode gallery all -o out`"
        );
    }
    let mut sources: Vec<String> = Vec::new();
    for word in from {
        let path = Path::new(word);
        if *word == ALL && !path.exists() {
            sources.extend(library::names().map(str::to_owned));
        } else if path.is_dir() {
            sources.extend(drawings_in(path)?);
        } else {
            sources.push((*word).to_owned());
        }
    }
    let mut complaints = Vec::new();
    let mut shapes = Vec::new();
    for read in read_all(&sources, options) {
        match read {
            Ok(shape) => shapes.push(shape),
            Err(complaint) => complaints.push(complaint),
        }
    }
    let listed = match list {
        None => None,
        Some(path) => {
            let lines = lines_of(path)?;
            let mut names: Vec<String> = Vec::new();
            for name in lines.iter().flat_map(|l| [&l.0, &l.1]) {
                if !names.contains(name) {
                    names.push(name.clone());
                }
            }
            let first_shape = shapes.len();
            let mut at: Vec<Option<usize>> = Vec::new();
            for read in read_all(&names, options) {
                match read {
                    Ok(shape) => {
                        at.push(Some(shapes.len()));
                        shapes.push(shape);
                    }
                    Err(complaint) => {
                        at.push(None);
                        complaints.push(complaint);
                    }
                }
            }
            sources.extend(names.iter().cloned());
            let index = |name: &String| names.iter().position(|n| n == name).and_then(|i| at[i]);
            let pairs = lines
                .iter()
                .filter_map(|(driver, follower, ratio)| {
                    let (driver, follower) = (index(driver)?, index(follower)?);
                    Some(ListedPair { driver, follower, ratio: *ratio })
                })
                .collect();
            Some(Listed { first_shape, pairs })
        }
    };
    Ok(Gathered { shapes, listed, complaints, sources })
}

fn read_all(sources: &[String], options: &LoadOptions) -> Vec<Result<Shape, String>> {
    sources.par_iter().map(|s| load(s, options).map_err(|e| e.to_string())).collect()
}

/// The drawings in a folder, by name.
fn drawings_in(folder: &Path) -> anyhow::Result<Vec<String>> {
    let told = || format!("{}: the folder cannot be read; check it", folder.display());
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .with_context(told)?
        .collect::<Result<Vec<_>, _>>()
        .with_context(told)?
        .into_iter()
        .map(|e| e.path())
        .filter(|p| {
            let ending = p.extension().map(|e| e.to_string_lossy().to_lowercase());
            let hidden = p.file_name().is_some_and(|n| n.to_string_lossy().starts_with('.'));
            p.is_file()
                && !hidden
                && !is_own_table(p)
                && ending.is_some_and(|e| DRAWINGS.contains(&e.as_str()))
        })
        .collect();
    files.sort();
    if files.is_empty() {
        bail!(
            "{}: there is no drawing in this folder; put files of {} there",
            folder.display(),
            DRAWINGS.join(", ")
        );
    }
    Ok(files.into_iter().map(|p| p.to_string_lossy().into_owned()).collect())
}

/// Whether it is a table that an earlier gallery left in this folder, beside its page.
fn is_own_table(path: &Path) -> bool {
    path.file_name().is_some_and(|n| TABLES.iter().any(|t| n == *t))
        && TABLES.iter().all(|n| path.with_file_name(n).is_file())
}

/// The words of a line up to a `#`; what is in quotes is one word. None where a quote is left open.
fn words_of(line: &str) -> Option<Vec<String>> {
    let mut words = Vec::new();
    let mut rest = line;
    loop {
        rest = rest.trim_start_matches([' ', '\t', ',', ';']);
        if rest.is_empty() || rest.starts_with('#') {
            return Some(words);
        }
        let (word, after) = match rest.strip_prefix('"') {
            Some(quoted) => quoted.split_once('"')?,
            None => rest.split_at(rest.find([' ', '\t', ',', ';', '#']).unwrap_or(rest.len())),
        };
        words.push(word.to_owned());
        rest = after;
    }
}

/// Drivers, followers and ratios of a list; shapes that are files beside it are named from here.
fn lines_of(path: &Path) -> anyhow::Result<Vec<(String, String, Option<Ratio>)>> {
    let text = std::fs::read_to_string(path).with_context(|| {
        format!("{}: the list cannot be read; give a text file", path.display())
    })?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let found = |name: &str| {
        let file = folder.join(name);
        let is_file = file.exists() || name.contains(['/', '\\', '.']);
        if is_file { file.to_string_lossy().into_owned() } else { name.to_owned() }
    };
    let mut lines = Vec::new();
    for (i, line) in text.lines().enumerate() {
        let Some(words) = words_of(line) else {
            bail!("{}: line {} has an open quote; close it", path.display(), i + 1);
        };
        let words: Vec<&str> = words.iter().map(String::as_str).collect();
        let ratio = |k: &str| {
            k.parse::<Ratio>().with_context(|| format!("{}: line {}", path.display(), i + 1))
        };
        match words[..] {
            [] => {}
            [driver, follower] => lines.push((found(driver), found(follower), None)),
            [driver, follower, k] => {
                lines.push((found(driver), found(follower), Some(ratio(k)?)));
            }
            _ => bail!(
                "{}: line {} names no pair; write DRIVER FOLLOWER, and K where it differs",
                path.display(),
                i + 1
            ),
        }
    }
    Ok(lines)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_with_blanks_stand_in_quotes() {
        let words = |line| words_of(line).unwrap_or_default();
        assert_eq!(words("a.svg, b 2 # c"), ["a.svg", "b", "2"]);
        assert_eq!(words(" \"a b.svg\" a.svg 2"), ["a b.svg", "a.svg", "2"]);
        assert_eq!(words("\"a #1, b\";c#d"), ["a #1, b", "c"]);
        assert!(words("# all").is_empty() && words(" ,").is_empty());
        assert_eq!(words_of("\"a b.svg a.svg"), None);
    }
}
