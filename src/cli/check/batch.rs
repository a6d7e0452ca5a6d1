//! `centrode check --batch PAIRS.csv`: a table of pairs, each judged by itself.

use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, anyhow, bail, ensure};
use centrode::diagnose::{Severity, of_severity};
use clap::{CommandFactory, Parser};
use serde_json::{Value, json};

use super::super::progress::Progress;
use super::super::{Outcome, in_one_line, told};
use super::args::{CheckArgs, PairFacts};
use super::{Case, Job, junit, print, record, report_of};

/// Bytes of a table, at most: a hundred thousand rows.
const TABLE_BYTES: u64 = 16 << 20;

/// Columns whose values are paths, seen from the table.
const PATHS: [&str; 4] = ["driver", "follower", "motion", "limits"];

/// A row, as the command line has it.
#[derive(Debug, Parser)]
struct Row {
    driver: String,
    follower: String,
    #[command(flatten)]
    facts: PairFacts,
}

pub(super) fn run(args: &CheckArgs, table: &Path) -> anyhow::Result<Outcome> {
    let jobs = jobs(args, table).with_context(|| table.display().to_string())?;
    let progress = Progress::new();
    let mut cases = Vec::new();
    for (i, job) in jobs.iter().enumerate() {
        progress.doing(format!("pair {} of {}", i + 1, jobs.len()));
        let start = Instant::now();
        let made = report_of(job, args, &progress).map_err(|error| told(&error));
        let (driver, follower) = (job.driver.clone(), job.follower.clone());
        let seconds = start.elapsed().as_secs_f64();
        cases.push(Case { driver, follower, seconds, made });
    }
    progress.done();
    if let Some(path) = &args.junit {
        junit::write(path, &cases)?;
    }
    print(&if args.json { json_of(&cases)? } else { human(&cases) })?;
    let bad: Vec<&Case> = cases.iter().filter(|case| case.made.is_err()).collect();
    if let Some(first) = bad.first() {
        let Err(why) = &first.made else { bail!("a pair was not judged") };
        bail!("{} of {} pairs cannot be judged, the first for: {why}", bad.len(), cases.len());
    }
    Ok(if cases.iter().all(Case::is_sound) { Outcome::Good } else { Outcome::NotSound })
}

fn jobs(args: &CheckArgs, table: &Path) -> anyhow::Result<Vec<Job>> {
    let length =
        std::fs::metadata(table).context("the table cannot be read; check the path")?.len();
    ensure!(length <= TABLE_BYTES, "the table has more than {TABLE_BYTES} bytes; split it");
    let text = std::fs::read_to_string(table)
        .context("the table cannot be read; give a text file with a row for each pair")?;
    let folder = table.parent().unwrap_or(Path::new(""));
    let mut rows = rows(text.trim_start_matches('\u{feff}'));
    let (_, head) = rows.next().ok_or_else(|| anyhow!("the table is empty; {HEAD}"))??;
    let head: Vec<String> =
        head.iter().map(|name| name.trim().to_lowercase().replace([' ', '_'], "-")).collect();
    let known = columns();
    for name in &head {
        ensure!(known.contains(name), "there is no column {name:?}; take {}", known.join(", "));
    }
    for name in ["driver", "follower"] {
        ensure!(head.iter().any(|h| h == name), "the column {name:?} is missing; {HEAD}");
    }
    let mut jobs = Vec::new();
    for row in rows {
        let (line, cells) = row?;
        let job = job(&head, &cells, folder).with_context(|| format!("line {line}"))?;
        jobs.push(Job { facts: job.facts.or(&args.facts), ..job });
    }
    ensure!(!jobs.is_empty(), "the table lists no pair; add a row for each");
    Ok(jobs)
}

/// What a table begins with.
const HEAD: &str = "begin with a line such as driver,follower,center-distance";

/// The names of the columns there may be.
fn columns() -> Vec<String> {
    let command = Row::command();
    let options = command.get_arguments().filter_map(|a| a.get_long().map(str::to_owned));
    ["driver", "follower"].map(str::to_owned).into_iter().chain(options).collect()
}

fn job(head: &[String], cells: &[String], folder: &Path) -> anyhow::Result<Job> {
    ensure!(
        cells.len() == head.len(),
        "it has {} cells under {} columns; put values with separators in quotes",
        cells.len(),
        head.len()
    );
    let (mut places, mut words) = (["", ""].map(str::to_owned), vec!["row".to_owned()]);
    for (name, cell) in head.iter().zip(cells) {
        let cell = cell.trim();
        if cell.is_empty() {
            continue;
        }
        let value =
            if PATHS.contains(&name.as_str()) { seen_from(folder, cell) } else { cell.to_owned() };
        match name.as_str() {
            "driver" => places[0] = value,
            "follower" => places[1] = value,
            _ => words.push(format!("--{name}={value}")),
        }
    }
    ensure!(places.iter().all(|p| !p.is_empty()), "a gear is missing; name a file for both");
    words.push("--".to_owned());
    words.extend(places);
    let row = Row::try_parse_from(words).map_err(|e| {
        let said = in_one_line(&e.to_string()).replace(" (--help lists the options)", "");
        anyhow!("{}", said.trim_start_matches("error: "))
    })?;
    Ok(Job { driver: row.driver, follower: row.follower, facts: row.facts })
}

fn seen_from(folder: &Path, path: &str) -> String {
    let path: PathBuf = folder.join(path);
    path.to_string_lossy().into_owned()
}

/// The rows of a table with the number of the line each begins on: cells parted by commas, semicolons or tabs, whichever the
/// head has, in quotes where they hold one. Empty lines and those that begin with # are left out.
fn rows(text: &str) -> impl Iterator<Item = anyhow::Result<(usize, Vec<String>)>> {
    let head = text.lines().find(|line| !is_blank(line)).unwrap_or_default();
    let separator = ['\t', ';'].into_iter().find(|c| head.contains(*c)).unwrap_or(',');
    let numbered = text.lines().enumerate().filter(|(_, line)| !is_blank(line));
    numbered.map(move |(i, line)| {
        let cells = cells(line, separator)
            .ok_or_else(|| anyhow!("line {}: a quote is not closed; close it", i + 1))?;
        Ok((i + 1, cells))
    })
}

fn is_blank(line: &str) -> bool {
    line.trim().is_empty() || line.trim_start().starts_with('#')
}

/// The cells of a line; none where a quote stays open.
fn cells(line: &str, separator: char) -> Option<Vec<String>> {
    let (mut cells, mut cell, mut quoted) = (Vec::new(), String::new(), false);
    let mut rest = line.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '"' if quoted && rest.next_if_eq(&'"').is_some() => cell.push('"'),
            '"' => quoted = !quoted,
            c if c == separator && !quoted => cells.push(std::mem::take(&mut cell)),
            c => cell.push(c),
        }
    }
    cells.push(cell);
    (!quoted).then_some(cells)
}

fn human(cases: &[Case]) -> String {
    let mut text = String::new();
    for case in cases {
        let pair = format!("{} and {}", case.driver, case.follower);
        match &case.made {
            Err(why) => text += &format!("not judged: {pair}: {why}\n"),
            Ok(report) => {
                text += &format!("{}: {pair}\n", report.verdict().label());
                for (severity, word) in [(Severity::Fault, "fault"), (Severity::Warning, "warning")]
                {
                    for found in of_severity(&report.diagnostics, severity) {
                        text += &format!("  {word}: {found}\n");
                    }
                }
            }
        }
    }
    let sound = cases.iter().filter(|case| case.is_sound()).count();
    text + &format!("{sound} of {} pairs mesh\n", cases.len())
}

/// A list with, for each pair, the record of `check --json` and its files, or an `error`.
fn json_of(cases: &[Case]) -> anyhow::Result<String> {
    let mut list = Vec::new();
    for case in cases {
        let mut value = match &case.made {
            Ok(report) => serde_json::from_str::<Value>(&record(report)?)?,
            Err(why) => json!({ "error": why }),
        };
        value["driver"] = json!(case.driver);
        value["follower"] = json!(case.follower);
        value["seconds"] = json!(case.seconds);
        list.push(value);
    }
    Ok(serde_json::to_string(&list)? + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn listed(text: &str) -> anyhow::Result<Vec<Job>> {
        let mut rows = rows(text);
        let (_, head) = rows.next().unwrap()?;
        rows.map(|row| job(&head, &row?.1, Path::new("gears"))).collect()
    }

    #[test]
    fn a_row_is_a_command_line() {
        let jobs = listed(
            "# wheels\ndriver;follower;center-distance;driver-axis;ratio\na.csv;\"b;1.csv\";7.2cm;1,-2;\n\n",
        )
        .unwrap();
        let [job] = &jobs[..] else { panic!("{jobs:?}") };
        assert_eq!(Path::new(&job.driver), Path::new("gears").join("a.csv"));
        assert_eq!(Path::new(&job.follower), Path::new("gears").join("b;1.csv"));
        assert_eq!(job.facts.center_distance, Some(72.0));
        assert_eq!(job.facts.driver_axis, Some(centrode::geometry::Point::new(1.0, -2.0)));
        let given =
            PairFacts { ratio: Some(2.0), center_distance: Some(1.0), ..PairFacts::default() };
        let facts = job.facts.clone().or(&given);
        assert_eq!((facts.ratio, facts.center_distance), (Some(2.0), Some(72.0)));
    }

    #[test]
    fn a_bad_row_is_told() {
        for (text, said) in [
            ("driver,follower\na.csv\n", "1 cells under 2"),
            ("driver,follower\na.csv,\n", "missing"),
            ("driver,follower\na.csv,\"b\n", "quote"),
            ("driver,follower,ratio\na,b,many\n", "many"),
        ] {
            let error = format!("{:#}", listed(text).unwrap_err());
            assert!(error.contains(said), "{text}: {error}");
        }
        assert!(columns().contains(&"limits".to_owned()));
    }

    #[test]
    fn quotes_hold_separators_and_quotes() {
        assert_eq!(cells("a,\"b,c\",\"d\"\"e\"", ',').unwrap(), ["a", "b,c", "d\"e"]);
        assert_eq!(cells("", ',').unwrap(), [""]);
        assert!(cells("\"a", ',').is_none());
    }
}
