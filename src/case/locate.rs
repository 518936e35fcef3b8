//! Where in the text of a case a key or an error stands.

use std::ops::Range;

use toml_edit::{Item, TableLike, Value};

/// An error of the TOML reader with its line and the path of its key.
pub struct Located {
    /// Line, from 1.
    pub line: usize,
    /// Path of the key, empty if the error stands at none.
    pub key: String,
}

/// Number of the line that holds byte `at`, from 1.
pub fn line_at(text: &[u8], at: usize) -> usize {
    text[..at.min(text.len())].split(|byte| *byte == b'\n').count()
}

/// Line of a key such as `particles.0.radius`, or of its nearest parent that stands in the text; 0 if none does.
pub fn line_of(text: &str, key: &str) -> usize {
    let Ok(document) = toml_edit::Document::parse(text) else { return 0 };
    let mut item = document.as_item();
    let mut start = None;
    for part in key.split('.') {
        let next = match part.parse::<usize>() {
            Ok(index) => item.get(index),
            Err(_) => item.get(part),
        };
        let Some(next) = next else { break };
        item = next;
        start = item.span().map(|span| span.start).or(start);
    }
    start.map_or(0, |at| line_at(text.as_bytes(), at))
}

/// Line of the key that a point of a sweep sets; 0 if it stands nowhere.
pub fn line_of_set(text: &str, axis: usize, point: usize, key: &str) -> usize {
    let Ok(document) = toml_edit::Document::parse(text) else { return 0 };
    let set = || document.as_item().get("vary")?.get(axis)?.get("points")?.get(point)?.get("set")?.get(key)?.span();
    set().map_or(0, |span| line_at(text.as_bytes(), span.start))
}

/// A key or a header of the document: its path, where it stands, and its value, if it is a key.
struct Leaf<'a> {
    path: String,
    span: Range<usize>,
    value: Option<&'a Value>,
}

/// Where an error of the TOML reader stands. The reader knows no more than the span of a whole table or array where the
/// table's `kind` chooses its type; the key is then the first one in it that the message speaks of.
pub fn locate(text: &str, error: &toml::de::Error) -> Located {
    let span = error.span().unwrap_or(0..0);
    let line = line_at(text.as_bytes(), span.start);
    let Ok(document) = toml_edit::Document::parse(text) else {
        let word = &text[span];
        let is_word = !word.is_empty() && word.chars().all(|c| c.is_ascii_alphanumeric() || "-_".contains(c));
        return Located { line, key: if is_word { word.to_owned() } else { String::new() } };
    };
    let mut leaves = Vec::new();
    collect_table(document.as_table(), "", &mut leaves);
    if span.is_empty() {
        // The document as a whole lacks something.
        return Located { line: 0, key: String::new() };
    }
    let holds = |leaf: &&Leaf| leaf.span.start <= span.start && span.end <= leaf.span.end;
    let Some(mut leaf) = leaves.iter().filter(holds).min_by_key(|leaf| leaf.span.len()) else {
        return Located { line, key: String::new() };
    };
    if let Some(element) = culprit(text, &leaf.path, error.message(), &leaves) {
        leaf = element;
    }
    let below = format!("{}.", leaf.path);
    let spoken = leaves.iter().find(|other| other.path.starts_with(&below) && speaks_of(error.message(), other));
    let leaf = spoken.unwrap_or(leaf);
    Located { line: line_at(text.as_bytes(), leaf.span.start), key: leaf.path.clone() }
}

/// The element of the array at `path` that alone makes the same error; the reader does not say which one it was.
fn culprit<'a, 'b>(text: &str, path: &str, message: &str, leaves: &'b [Leaf<'a>]) -> Option<&'b Leaf<'a>> {
    let table: toml::Table = toml::from_str(text).ok()?;
    // The first header of an array of tables stands for the array.
    let path = path.strip_suffix(".0").unwrap_or(path);
    let mut parts = path.split('.');
    let mut found = table.get(parts.next()?)?;
    for part in parts {
        found = match part.parse::<usize>() {
            Ok(index) => found.as_array()?.get(index)?,
            Err(_) => found.get(part)?,
        };
    }
    let fails_alone = |element: &toml::Value| {
        let mut alone = table.clone();
        super::sweep::replace(&mut alone, path, toml::Value::Array(vec![element.clone()])).is_ok()
            && super::sweep::typed(&alone).is_err_and(|error| error.message() == message)
    };
    let index = found.as_array()?.iter().position(fails_alone)?;
    leaves.iter().find(|leaf| leaf.path == format!("{path}.{index}"))
}

/// Whether a message of the reader can be about this key or value.
fn speaks_of(message: &str, leaf: &Leaf) -> bool {
    let about = message.split(", expected").next().unwrap_or_default();
    let quotes =
        |mark: char, text: &str| about.split(mark).skip(1).step_by(2).any(|quoted| quoted.trim() == text.trim());
    let key = leaf.path.rsplit('.').next().unwrap_or_default();
    if message.starts_with("unknown field") {
        return quotes('`', key);
    }
    match leaf.value {
        Some(Value::String(text)) => quotes('`', text.value()) || quotes('"', text.value()),
        Some(Value::Integer(value)) => about.contains(&format!("integer `{}`", value.value())),
        Some(Value::Float(value)) => {
            let value = *value.value();
            about.contains(&format!("floating point `{value:?}`")) || about == format!("{value} is not a finite number")
        }
        Some(Value::Boolean(value)) => about.contains(&format!("boolean `{}`", value.value())),
        Some(Value::Array(values)) => {
            about == format!("invalid length {}", values.len()) || about.contains("invalid type: sequence")
        }
        Some(Value::InlineTable(_)) => about.contains("invalid type: map"),
        Some(Value::Datetime(_)) => about.contains("invalid type: datetime"),
        None => false,
    }
}

fn collect_table<'a>(table: &'a dyn TableLike, path: &str, leaves: &mut Vec<Leaf<'a>>) {
    let header = |path: &str, span: Option<Range<usize>>, leaves: &mut Vec<Leaf<'a>>| {
        leaves.extend(span.map(|span| Leaf { path: path.to_owned(), span, value: None }));
    };
    for (key, item) in table.iter() {
        let path = if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        let start = table.key(key).and_then(toml_edit::Key::span).map(|span| span.start);
        match item {
            Item::None => {}
            Item::Value(value) => collect_value(value, &path, start, leaves),
            Item::Table(inner) => {
                header(&path, inner.span(), leaves);
                collect_table(inner, &path, leaves);
            }
            Item::ArrayOfTables(tables) => {
                for (index, inner) in tables.iter().enumerate() {
                    let path = format!("{path}.{index}");
                    header(&path, inner.span(), leaves);
                    collect_table(inner, &path, leaves);
                }
            }
        }
    }
}

/// Adds a value and what it holds; a value starts where its key does.
fn collect_value<'a>(value: &'a Value, path: &str, start: Option<usize>, leaves: &mut Vec<Leaf<'a>>) {
    if let Some(span) = value.span() {
        let span = start.unwrap_or(span.start)..span.end;
        leaves.push(Leaf { path: path.to_owned(), span, value: Some(value) });
    }
    match value {
        Value::Array(items) => {
            for (index, item) in items.iter().enumerate() {
                collect_value(item, &format!("{path}.{index}"), None, leaves);
            }
        }
        Value::InlineTable(inner) => collect_table(inner, path, leaves),
        _ => {}
    }
}
