//! `centrode completions` and `centrode man`: what a system installs beside the program.

use std::io::Write;

use anyhow::Context;
use centrode::export::{check_folder, write_atomically};
use clap::CommandFactory;
use clap_mangen::Man;

use super::args::{Cli, CompletionsArgs, ManArgs};
use super::{Outcome, progress};

const NAME: &str = "centrode";

pub(crate) fn completions(args: &CompletionsArgs) -> anyhow::Result<Outcome> {
    let mut script = Vec::new();
    clap_complete::generate(args.shell, &mut Cli::command(), NAME, &mut script);
    print(&script)
}

pub(crate) fn man(args: &ManArgs) -> anyhow::Result<Outcome> {
    let mut command = Cli::command();
    command.build();
    let page = |command: clap::Command| -> anyhow::Result<Vec<u8>> {
        let mut page = Vec::new();
        Man::new(command).render(&mut page)?;
        Ok(page)
    };
    let Some(folder) = &args.output else {
        return print(&page(command)?);
    };
    check_folder(folder)?;
    std::fs::create_dir_all(folder).with_context(|| {
        format!("cannot make the folder {}; give one that may be written to", folder.display())
    })?;
    let mut pages = vec![(NAME.to_owned(), command.clone())];
    add_pages(&command, NAME, &mut pages);
    for (name, command) in pages {
        let path = folder.join(format!("{name}.1"));
        let text = page(command)?;
        write_atomically(&path, |out| out.write_all(&text))?;
        if !progress::is_silent() {
            println!("{}", path.display());
        }
    }
    Ok(Outcome::Good)
}

/// Adds the commands below `command`, whose page is called `name`, and those below them.
fn add_pages(command: &clap::Command, name: &str, pages: &mut Vec<(String, clap::Command)>) {
    for sub in command.get_subcommands().filter(|s| s.get_name() != "help") {
        let name = format!("{name}-{}", sub.get_name());
        pages.push((name.clone(), sub.clone().display_name(name.clone())));
        add_pages(sub, &name, pages);
    }
}

fn print(bytes: &[u8]) -> anyhow::Result<Outcome> {
    std::io::stdout().lock().write_all(bytes).context("cannot write to standard output")?;
    Ok(Outcome::Good)
}
