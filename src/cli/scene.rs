//! `centrode run` and `--save-scene`: scenes translated to and from the command line that clap knows.

use std::ffi::OsString;
use std::path::{Component, Path, PathBuf};

use anyhow::{Context, anyhow, bail};
use centrode::export::{check_inputs, prepare_folder, write_atomically};
use centrode::scene::{Key, Kind, Setting, command_of, read, write};
use clap::parser::ValueSource;
use clap::{Arg, ArgAction, ArgMatches, CommandFactory, Parser, ValueHint};

use super::args::{Cli, SceneArgs};
use super::files::{check_file, told_of};
use super::{Outcome, in_one_line};

/// Headings of the help and the tables of a scene that hold their options. An option under another heading stands in a table named
/// after that heading's first word; one under none stands at the top.
const TABLES: [(&str, &str); 3] =
    [("Reading the shapes", "shapes"), ("Fitting", "fit"), ("Files", "export")];

/// Commands that no scene can name.
const NO_SCENE: [&str; 3] = ["run", "studio", "help"];

/// Options that say nothing of the result.
const LEFT_OUT: [&str; 3] = ["help", "version", "save_scene"];

/// The option that names where a scene is saved.
const SAVE: &str = "--save-scene";

/// Where results of a scene go that names no folder.
const OUTPUT: &str = "output";

/// Greatest length of a scene, bytes: far beyond what all options take.
const LONGEST_SCENE: u64 = 1 << 20;

/// Carries a scene out.
pub(crate) fn run(args: &SceneArgs) -> anyhow::Result<Outcome> {
    let told = || args.scene.display().to_string();
    let words = words_of(args).with_context(told)?;
    let cli = Cli::try_parse_from(&words)
        .map_err(|e| {
            anyhow!("{}", in_one_line(&e.to_string()).trim_start_matches("error: ").to_owned())
        })
        .with_context(told)?;
    super::carry_out(&cli, &words)
}

/// The command line that a scene stands for.
fn words_of(args: &SceneArgs) -> anyhow::Result<Vec<OsString>> {
    let size = std::fs::metadata(&args.scene).context("cannot read the scene; check the path")?;
    if !size.is_file() || size.len() > LONGEST_SCENE {
        bail!("this is no scene; name a TOML file such as --save-scene writes");
    }
    let text = std::fs::read_to_string(&args.scene)
        .context("cannot read the scene; give a text file in UTF-8")?;
    let top = Cli::command();
    let names: Vec<&str> = top
        .get_subcommands()
        .map(clap::Command::get_name)
        .filter(|n| !NO_SCENE.contains(n))
        .collect();
    let command = command_of(&text, names.iter().copied())?;
    let Some(known) = top.find_subcommand(command) else { bail!("there is no command {command}") };
    let folder = args.scene.parent().unwrap_or(Path::new(""));
    let said = read(&text, &keys(known))?;
    // An option after -- takes the place of the scene's, in its long or its short form.
    let overridden = |key: &str| {
        let long = format!("--{key}");
        let short = known.get_arguments().find(|a| name_of(a) == key).and_then(Arg::get_short);
        let is_it = |w: &str| {
            w == long
                || w.starts_with(&format!("{long}="))
                || short.is_some_and(|c| w.starts_with(&format!("-{c}")))
        };
        args.more.iter().any(|w| w.to_str().is_some_and(is_it))
    };
    let mut options: Vec<OsString> = Vec::new();
    let mut places: Vec<(usize, OsString)> = Vec::new();
    for setting in said {
        let Some(arg) = known.get_arguments().find(|a| name_of(a) == setting.key) else { continue };
        if overridden(&setting.key) || (arg.get_id() == OUTPUT && args.output.is_some()) {
            continue;
        }
        let mut values = setting.values.iter().map(|v| resolved(arg, v, folder));
        if arg.is_positional() {
            let index = known.get_positionals().position(|p| p.get_id() == arg.get_id());
            let index = index.unwrap_or_default();
            places.extend(values.map(|v| (index, v)));
        } else if setting.values.is_empty() {
            options.push(format!("--{}", setting.key).into());
        } else if let Some(delimiter) = arg.get_value_delimiter() {
            let mut word = OsString::from(format!("--{}=", setting.key));
            word.push(values.next().unwrap_or_default());
            for value in values {
                word.push(delimiter.to_string());
                word.push(value);
            }
            options.push(word);
        } else {
            for value in values {
                let mut word = OsString::from(format!("--{}=", setting.key));
                word.push(value);
                options.push(word);
            }
        }
    }
    places.sort_by_key(|p| p.0);
    let mut words: Vec<OsString> = vec!["centrode".into(), command.into()];
    words.append(&mut options);
    words.extend(args.more.iter().cloned());
    let takes_output = known.get_arguments().any(|a| a.get_id() == OUTPUT);
    let has_output = words.iter().any(|w| w.to_string_lossy().starts_with("--output="));
    match &args.output {
        Some(folder) if takes_output => {
            let mut word = OsString::from("--output=");
            word.push(folder);
            words.push(word);
        }
        None if takes_output && !has_output && !overridden(OUTPUT) => {
            let mut word = OsString::from("--output=");
            word.push(Path::new("out").join(args.scene.file_stem().unwrap_or_default()));
            words.push(word);
        }
        _ => {}
    }
    if !places.is_empty() {
        words.push("--".into());
        words.extend(places.into_iter().map(|p| p.1));
    }
    Ok(words)
}

/// Whether the scene of `words` can be written: told before the work is done.
pub(crate) fn check_save(path: &Path, words: &[OsString]) -> anyhow::Result<()> {
    let top = Cli::command();
    let matches = Cli::command().try_get_matches_from(words)?;
    let Some((name, given)) = matches.subcommand() else { bail!("there is no command to save") };
    let Some(known) = top.find_subcommand(name) else { bail!("there is no command {name}") };
    if NO_SCENE.contains(&name) {
        bail!("`centrode {name}` has no scene of its own; save that of the command it carries out");
    }
    if let Some((step, _)) = given.subcommand() {
        bail!("`centrode {name} {step}` has no scene; leave out {SAVE}");
    }
    let told = |error| told_of(SAVE, error);
    check_file(path).map_err(told)?;
    let mut values: Vec<String> =
        given_settings(known, given).into_iter().flat_map(|s| s.values).collect();
    // The gear that is meant may be named behind its file.
    let files: Vec<String> =
        values.iter().filter_map(|v| Some(v.rsplit_once('#')?.0.to_owned())).collect();
    values.extend(files);
    let folder = path.parent().unwrap_or(Path::new(""));
    let name: Vec<_> = path.file_name().into_iter().collect();
    check_inputs(&values, "file", folder, &name).map_err(told)
}

/// Writes the scene that makes `words` again.
pub(crate) fn save(path: &Path, words: &[OsString]) -> anyhow::Result<()> {
    let folder = path.parent().unwrap_or(Path::new(""));
    let text = text(words, folder)?;
    if !folder.as_os_str().is_empty() {
        prepare_folder(folder).map_err(|e| told_of(SAVE, e))?;
    }
    write_atomically(path, |out| std::io::Write::write_all(out, text.as_bytes()))
        .map_err(|e| told_of(SAVE, e))
}

/// The scene that makes `words` again, as a file in `folder` says it.
pub(super) fn text(words: &[OsString], folder: &Path) -> anyhow::Result<String> {
    let top = Cli::command();
    let matches = Cli::command().try_get_matches_from(words)?;
    let Some((name, given)) = matches.subcommand() else { bail!("there is no command to save") };
    let Some(known) = top.find_subcommand(name) else { bail!("there is no command {name}") };
    let settings: Vec<Setting> = given_settings(known, given)
        .into_iter()
        .filter(|s| s.key != OUTPUT)
        .map(|mut setting| {
            if let Some(arg) = known.get_arguments().find(|a| name_of(a) == setting.key) {
                let values = setting.values.iter().map(|v| seen_from(arg, v, folder));
                setting.values = values.collect();
            }
            setting
        })
        .collect();
    Ok(write(name, &keys(known), &settings))
}

/// A scene in parts: its command, the values without a name in their order, and the options with their values.
pub(super) type Parts = (String, Vec<String>, Vec<Setting>);

/// The parts of the scene in `text`, its paths as they stand there.
pub(super) fn parts(text: &str) -> anyhow::Result<Parts> {
    let top = Cli::command();
    let names: Vec<&str> = top
        .get_subcommands()
        .map(clap::Command::get_name)
        .filter(|n| !NO_SCENE.contains(n))
        .collect();
    let command = command_of(text, names.iter().copied())?;
    let Some(known) = top.find_subcommand(command) else { bail!("there is no command {command}") };
    let (mut places, mut options) = (Vec::new(), Vec::new());
    for setting in read(text, &keys(known))? {
        match known.get_positionals().position(|p| name_of(p) == setting.key) {
            Some(index) => places.extend(setting.values.into_iter().map(|v| (index, v))),
            None => options.push(setting),
        }
    }
    places.sort_by_key(|p| p.0);
    Ok((command.to_owned(), places.into_iter().map(|p| p.1).collect(), options))
}

/// What was said on the command line itself, defaults left out, in the order of the help.
pub(crate) fn given_settings(known: &clap::Command, given: &ArgMatches) -> Vec<Setting> {
    let told = |arg: &&Arg| {
        given.try_contains_id(arg.get_id().as_str()).is_ok()
            && given.value_source(arg.get_id().as_str()) == Some(ValueSource::CommandLine)
    };
    shown(known)
        .filter(told)
        .map(|arg| {
            let raw = given.try_get_raw(arg.get_id().as_str()).ok().flatten();
            let flag = kind(arg) == Kind::Flag;
            let values = raw.filter(|_| !flag).into_iter().flatten();
            Setting {
                key: name_of(arg),
                values: values.map(|v| v.to_string_lossy().into_owned()).collect(),
            }
        })
        .collect()
}

fn shown(command: &clap::Command) -> impl Iterator<Item = &Arg> {
    command.get_arguments().filter(|a| !LEFT_OUT.contains(&a.get_id().as_str()))
}

/// The keys of a scene for a command.
fn keys(command: &clap::Command) -> Vec<Key> {
    shown(command)
        .map(|arg| Key {
            name: name_of(arg),
            table: arg.get_help_heading().map(table),
            kind: kind(arg),
            help: arg.get_help().map(ToString::to_string).unwrap_or_default(),
            default: arg
                .get_default_values()
                .first()
                .filter(|_| kind(arg) != Kind::Flag)
                .map(|v| v.to_string_lossy().into_owned()),
        })
        .collect()
}

fn name_of(arg: &Arg) -> String {
    arg.get_long().map_or_else(|| arg.get_id().as_str().replace('_', "-"), str::to_owned)
}

fn table(heading: &str) -> String {
    let known = TABLES.iter().find(|(h, _)| *h == heading).map(|(_, t)| (*t).to_owned());
    known.unwrap_or_else(|| {
        let first = heading.split(|c: char| !c.is_alphanumeric()).next().unwrap_or("more");
        first.to_lowercase()
    })
}

fn kind(arg: &Arg) -> Kind {
    let many = arg.get_value_delimiter().is_some()
        || matches!(arg.get_action(), ArgAction::Append)
        || arg.get_num_args().is_some_and(|n| n.max_values() > 1);
    match arg.get_action() {
        ArgAction::SetTrue | ArgAction::SetFalse | ArgAction::Count => Kind::Flag,
        _ if many => Kind::Many,
        _ => Kind::One,
    }
}

/// Whether the value may name a file, and whether it must.
fn names_file(arg: &Arg) -> (bool, bool) {
    match arg.get_value_hint() {
        ValueHint::FilePath | ValueHint::DirPath => (true, false),
        ValueHint::AnyPath => (true, true),
        _ => (false, false),
    }
}

/// A value of a scene in `folder`, as it is called from here.
fn resolved(arg: &Arg, value: &str, folder: &Path) -> OsString {
    let (may, must) = names_file(arg);
    let path = folder.join(value);
    // A word alone may be a built-in name; whatever has a folder or an ending is a file.
    let looks_like_file = value.contains(['/', '\\', '.']);
    if may && (must || looks_like_file || path.exists()) { path.into() } else { value.into() }
}

/// A value given here, as it is called from `folder`.
fn seen_from(arg: &Arg, value: &str, folder: &Path) -> String {
    let (may, must) = names_file(arg);
    if !may || !(must || Path::new(value).exists()) || Path::new(value).is_absolute() {
        return value.to_owned();
    }
    let absolute = |p: &Path| {
        let p = if p.as_os_str().is_empty() { Path::new(".") } else { p };
        p.canonicalize().or_else(|_| std::path::absolute(p)).unwrap_or_else(|_| p.to_owned())
    };
    let (target, from) = (absolute(Path::new(value)), absolute(folder));
    let shared = target.components().zip(from.components()).take_while(|(a, b)| a == b).count();
    let mut way: PathBuf = from.components().skip(shared).map(|_| Component::ParentDir).collect();
    way.extend(target.components().skip(shared));
    let text = way.to_string_lossy().into_owned();
    // Else it would be taken for a built-in name.
    if text.contains(['/', '\\', '.']) { text } else { format!("./{text}") }
}
