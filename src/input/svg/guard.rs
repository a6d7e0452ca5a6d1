//! What is checked before an SVG is expanded: its size, its nesting and where its `use`
//! elements lead. A kilobyte of nested `use` can ask for a billion copies.

use super::SvgError;
use crate::policy;
use crate::wording::quoted;
use std::collections::HashMap;
use usvg::roxmltree::{Document, Error, Node, NodeId, ParsingOptions};

/// Style forced on every drawing. It switches off what is not part of a silhouette and can
/// multiply in ways that the count below does not see: markers, filters, paint inside of patterns, and, where a style sheet
/// gives clip paths or masks to any number of elements, those within other clip paths and masks.
pub(super) fn style(document: &Document<'_>) -> String {
    let mut style = "* { marker: none !important; filter: none !important } \
        pattern * { fill: black !important } pattern use { display: none !important }"
        .to_owned();
    if !covers_of_sheets(document).is_empty() {
        style += " clipPath, clipPath *, mask, mask * { clip-path: none !important; mask: none !important }";
    }
    style
}

/// Ids of clip paths and masks that style sheets hand out.
fn covers_of_sheets<'a>(document: &'a Document<'_>) -> Vec<&'a str> {
    let sheets = document.descendants().filter(|n| n.tag_name().name() == "style");
    let texts = sheets.filter_map(|n| n.text());
    let mut ids: Vec<&str> = texts.flat_map(cover_values).filter_map(link).collect();
    ids.sort_unstable();
    ids.dedup();
    ids
}

/// Values of `clip-path` and `mask` in CSS text.
fn cover_values(css: &str) -> Vec<&str> {
    ["clip-path", "mask"]
        .into_iter()
        .flat_map(|name| css.split(name).skip(1))
        .filter_map(|rest| rest.trim_start().strip_prefix(':'))
        .filter_map(|rest| rest.split([';', '}']).next())
        .map(|value| value.trim().trim_end_matches("!important").trim_end())
        .collect()
}

/// The id that `url(#id)` refers to.
fn link(value: &str) -> Option<&str> {
    value.strip_prefix("url(")?.split(')').next()?.trim_matches(['"', '\'', ' ']).strip_prefix('#')
}

/// Refuses covers that would not be applied: shapes that CSS alone draws, and covers of style sheets that hold a `use`, which
/// could lead back to them.
fn refuse_unread_covers(document: &Document<'_>) -> Result<(), SvgError> {
    let named = |names: &'static [&'static str]| {
        document.descendants().filter(move |n| names.contains(&n.tag_name().name()))
    };
    let attributes = document.descendants().filter_map(|n| n.attribute("clip-path"));
    let css = document.descendants().filter_map(|n| n.attribute("style"));
    let values = css.chain(named(&["style"]).filter_map(|n| n.text())).flat_map(cover_values);
    let drawn = |v: &&str| SHAPES.iter().any(|shape| v.trim().starts_with(shape));
    if let Some(value) = values.chain(attributes).find(drawn) {
        return Err(SvgError::Cover { value: quoted(value) });
    }
    let is_use = |n: Node| n.tag_name().name() == "use";
    match covers_of_sheets(document).first() {
        Some(id) if named(&["clipPath", "mask"]).any(|n| n.descendants().any(is_use)) => {
            Err(SvgError::Cover { value: quoted(&format!("url(#{id})")) })
        }
        _ => Ok(()),
    }
}

/// What begins a clip path that CSS draws itself.
const SHAPES: [&str; 6] = ["circle(", "ellipse(", "inset(", "polygon(", "path(", "rect("];

/// Parses the XML and refuses drawings whose expansion would be too large, deep or endless.
pub(super) fn checked(text: &str) -> Result<Document<'_>, SvgError> {
    if text.len() > policy::SVG_BYTES {
        return Err(SvgError::TooLong { bytes: text.len(), limit: policy::SVG_BYTES });
    }
    let text = text.trim_start_matches('\u{feff}');
    let too_many = SvgError::TooManyElements { limit: policy::SVG_ELEMENTS };
    if most_attributes(text) > policy::SVG_ATTRIBUTES {
        return Err(too_many);
    }
    // Text and attribute-free nodes count too, so leave some room above the elements.
    let limit = u32::try_from(4 * policy::SVG_ELEMENTS).unwrap_or(u32::MAX);
    let options = ParsingOptions { allow_dtd: true, nodes_limit: limit, entity_resolver: None };
    let document = Document::parse_with_options(text, options).map_err(|error| match error {
        Error::NodesLimitReached => too_many.clone(),
        other => SvgError::NotXml { reason: quoted(&other.to_string()) },
    })?;
    let root = document.root_element();
    if root.tag_name().name() != "svg" {
        return Err(SvgError::NotSvg { root: quoted(root.tag_name().name()) });
    }
    let ids = document.descendants().rev().filter_map(|n| Some((n.attribute("id")?, n))).collect();
    let mut counter = Counter { ids, known: HashMap::new() };
    let size = counter.expanded(root, 0)?;
    // Every element may have each of the covers that style sheets hand out.
    let mut covers = 1_u64;
    for id in covers_of_sheets(&document) {
        if let Some(target) = counter.ids.get(id).copied() {
            covers = covers.saturating_add(counter.expanded(target, 0)?.elements);
        }
    }
    let size = Expansion { elements: size.elements.saturating_mul(covers), ..size };
    refuse_unread_covers(&document)?;
    let rules = style_rules(&document);
    if size.elements > policy::SVG_ELEMENTS
        || size.path_bytes > policy::SVG_PATH_BYTES
        || size.elements.saturating_mul(rules) > policy::SVG_STYLE_TESTS
    {
        return Err(too_many);
    }
    Ok(document)
}

/// The largest number of quoted values between one `<` and its `>`. Comments and declarations
/// are passed over as far as their first `>`.
fn most_attributes(text: &str) -> usize {
    let (mut most, mut count) = (0, 0);
    let mut in_tag = false;
    let mut quote = None;
    let bytes = text.as_bytes();
    for (i, &byte) in bytes.iter().enumerate() {
        if let Some(open) = quote {
            if byte == open {
                quote = None;
            }
        } else if in_tag {
            match byte {
                b'"' | b'\'' => {
                    quote = Some(byte);
                    count += 1;
                    most = most.max(count);
                }
                b'>' => in_tag = false,
                _ => {}
            }
        } else if byte == b'<' && !matches!(bytes.get(i + 1), Some(b'!' | b'?')) {
            in_tag = true;
            count = 0;
        }
    }
    most
}

/// The largest magnitude among the numbers of path data. Flags of arcs that are written without a blank count with the
/// number behind them.
fn largest_number(data: &str) -> f64 {
    let bytes = data.as_bytes();
    let digits = |from: usize| {
        from + bytes[from..].iter().take_while(|b| b.is_ascii_digit() || **b == b'.').count()
    };
    let mut largest = 0.0_f64;
    let mut at = 0;
    while at < bytes.len() {
        let mut end = digits(at);
        if end == at {
            at += 1;
            continue;
        }
        if matches!(bytes.get(end), Some(b'e' | b'E')) {
            let sign = usize::from(matches!(bytes.get(end + 1), Some(b'+' | b'-')));
            let exponent = digits(end + 1 + sign);
            if exponent > end + 1 + sign {
                end = exponent;
            }
        }
        // What is no number, such as `1.2.3`, is two of them.
        let value = data[at..end]
            .parse()
            .or_else(|_| data[at..end].split('.').next().unwrap_or("0").parse());
        largest = largest.max(value.unwrap_or(0.0_f64));
        at = end;
    }
    largest
}

fn style_rules(document: &Document) -> u64 {
    let sheets = document.descendants().filter(|n| n.tag_name().name() == "style");
    let rules: usize = sheets.filter_map(|n| n.text()).map(|t| t.matches(['{', ',']).count()).sum();
    rules as u64
}

#[derive(Clone, Copy, Default)]
struct Expansion {
    elements: u64,
    path_bytes: u64,
    depth: u32,
}

enum State {
    Open,
    Done(Expansion),
}

struct Counter<'a, 'input> {
    ids: HashMap<&'a str, Node<'a, 'input>>,
    known: HashMap<NodeId, State>,
}

impl<'a, 'input> Counter<'a, 'input> {
    /// Counts what `node` becomes with every `use` expanded; each element is visited once.
    fn expanded(&mut self, node: Node<'a, 'input>, above: u32) -> Result<Expansion, SvgError> {
        let too_deep = SvgError::TooDeep { limit: policy::SVG_DEPTH };
        match self.known.get(&node.id()) {
            Some(State::Done(known)) if above + known.depth > policy::SVG_DEPTH => {
                return Err(too_deep);
            }
            Some(State::Done(known)) => return Ok(*known),
            Some(State::Open) => {
                let id = quoted(node.attribute("id").unwrap_or_default());
                return Err(SvgError::Circular { id });
            }
            None if above > policy::SVG_DEPTH => return Err(too_deep),
            None => {}
        }
        self.known.insert(node.id(), State::Open);
        let limit = policy::OUTLINE_RANGE.1;
        let value = node.attribute("d").map_or(0.0, largest_number);
        if value > limit {
            return Err(SvgError::Far { value, limit });
        }
        let data = [node.attribute("d"), node.attribute("points")];
        let path_bytes: usize = data.into_iter().flatten().map(str::len).sum();
        let mut total = Expansion { elements: 1, path_bytes: path_bytes as u64, depth: 0 };
        let targets = self.use_target(node).into_iter().chain(self.covers(node));
        for child in node.children().filter(Node::is_element).chain(targets.collect::<Vec<_>>()) {
            let part = self.expanded(child, above + 1)?;
            total.elements = total.elements.saturating_add(part.elements);
            total.path_bytes = total.path_bytes.saturating_add(part.path_bytes);
            total.depth = total.depth.max(part.depth + 1);
        }
        self.known.insert(node.id(), State::Done(total));
        Ok(total)
    }

    /// The clip path and the mask of an element.
    fn covers(&self, node: Node<'a, 'input>) -> Vec<Node<'a, 'input>> {
        let values =
            ["clip-path", "mask", "style"].into_iter().filter_map(|name| node.attribute(name));
        let ids = values.flat_map(|v| v.match_indices("url(").filter_map(|(at, _)| link(&v[at..])));
        let targets = ids.filter_map(|id| self.ids.get(id).copied());
        targets.filter(|n| matches!(n.tag_name().name(), "clipPath" | "mask")).collect()
    }

    fn use_target(&self, node: Node<'a, 'input>) -> Option<Node<'a, 'input>> {
        if node.tag_name().name() != "use" {
            return None;
        }
        self.ids.get(reference(node)?.trim().strip_prefix('#')?).copied()
    }
}

fn reference<'a>(node: Node<'a, '_>) -> Option<&'a str> {
    node.attribute("href").or_else(|| node.attribute(("http://www.w3.org/1999/xlink", "href")))
}

/// Whether path data can be read to its end: known commands, each with as many numbers as it takes.
fn is_path_data(data: &str) -> bool {
    let data = data.trim();
    let is_command = |c: char| c.is_ascii_alphabetic() && !matches!(c, 'e' | 'E');
    let starts: Vec<usize> =
        data.char_indices().filter(|(_, c)| is_command(*c)).map(|(at, _)| at).collect();
    let ends = starts.iter().skip(1).copied().chain([data.len()]);
    let complete = starts.iter().zip(ends).all(|(&start, end)| {
        let numbers = data.get(start + 1..end).and_then(count_numbers);
        numbers.is_some_and(|count| match data.as_bytes()[start].to_ascii_lowercase() {
            b'm' | b'l' | b't' => count > 0 && count % 2 == 0,
            b'h' | b'v' => count > 0,
            b's' | b'q' => count > 0 && count % 4 == 0,
            b'c' => count > 0 && count % 6 == 0,
            // Flags may be written without a blank behind them.
            b'a' => count >= 4,
            b'z' => count == 0,
            _ => false,
        })
    });
    data.is_empty() || (data.starts_with(['M', 'm']) && complete)
}

/// How many numbers stand between two commands, or none if there is something else.
fn count_numbers(text: &str) -> Option<usize> {
    let (mut count, mut within, mut point, mut exponent, mut after_e) =
        (0, false, false, false, false);
    for c in text.chars() {
        let starts = match c {
            '0'..='9' => !within,
            '.' => !within || point || exponent,
            '+' | '-' => !after_e,
            'e' | 'E' if within && !exponent => {
                (exponent, after_e) = (true, true);
                continue;
            }
            ',' => {
                within = false;
                continue;
            }
            c if c.is_ascii_whitespace() => {
                within = false;
                continue;
            }
            _ => return None,
        };
        if starts {
            count += 1;
            (within, point, exponent) = (true, false, false);
        }
        point |= c == '.';
        after_e = false;
    }
    Some(count)
}

/// The reason to tell when no visible filled path was found.
pub(super) fn why_nothing_is_filled(document: &Document) -> SvgError {
    const SHAPES: [&str; 7] = ["path", "rect", "circle", "ellipse", "polygon", "polyline", "line"];
    let has = |test: &dyn Fn(Node) -> bool| document.descendants().any(test);
    let named = |n: Node, names: &[&str]| names.contains(&n.tag_name().name());
    let paths = document.descendants().filter(|n| named(*n, &["path"]));
    if let Some(data) = paths.filter_map(|n| n.attribute("d")).find(|d| !is_path_data(d)) {
        let text = quoted(&data.trim().chars().take(40).collect::<String>());
        return SvgError::PathData { text };
    }
    if has(&|n| named(n, &SHAPES)) {
        SvgError::NothingFilled
    } else if has(&|n| named(n, &["text"])) {
        SvgError::OnlyText
    } else if has(&|n| {
        named(n, &["use", "image"])
            && reference(n).is_some_and(|r| !r.trim().starts_with(['#']) && !r.starts_with("data:"))
    }) {
        SvgError::OnlyReferences
    } else if has(&|n| named(n, &["image"])) {
        SvgError::OnlyImages
    } else {
        SvgError::Empty
    }
}
