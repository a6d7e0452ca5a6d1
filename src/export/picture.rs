//! The picture of the pair, 1:1 in millimetres.

use super::{Artifact, Encode, EncodeError, Parts};
use crate::report::{PictureOptions, pair_svg};

/// `pair.svg`: the gears in mesh with their pitch curves.
#[derive(Clone, Copy, Debug, Default)]
pub struct Picture;

impl Encode for Picture {
    fn encode<'a>(&'a self, parts: Parts<'a>) -> Result<Vec<Artifact<'a>>, EncodeError> {
        let text = pair_svg(parts.assembly, &PictureOptions::default());
        Ok(vec![Artifact::bytes("pair.svg", text)])
    }
}
