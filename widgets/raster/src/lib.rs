#![doc = include_str!("../README.md")]
//!
//! # Why it is here
//!
//! Paths are filled by [`fill`], lines with a width by [`stroke`], and what needs no path by [`blit`]; there is nothing else.
//! tiny-skia's filling knows gradients, blend modes, filters and masks in tables that no linker can see through, and its strokes
//! know curves, together 35 KB of the page; the tests hold ours against it.
//!
//! A package of its own, because it decides the time of a frame: it is compiled for speed, the figures for size.

pub mod blit;
pub mod fill;
pub mod path;
pub mod stroke;

/// Red, green, blue and 255: every pixel is opaque.
pub type Color = [u8; 4];

/// A picture, row by row.
#[derive(Clone, Debug)]
pub struct Pixels {
    width: usize,
    colors: Vec<Color>,
}

impl Pixels {
    /// Black, width × height \[px\]; a side is at least 1.
    pub fn new([width, height]: [u32; 2]) -> Self {
        let [width, height] = [width, height].map(|side| side.max(1) as usize);
        Self { width, colors: vec![[0, 0, 0, 255]; width * height] }
    }

    /// Width and height \[px\].
    pub fn size(&self) -> [u32; 2] {
        [self.width as u32, self.height() as u32]
    }

    /// RGBA, row by row.
    pub fn bytes(&self) -> &[u8] {
        self.colors.as_flattened()
    }

    /// The same, to be painted on.
    pub fn bytes_mut(&mut self) -> &mut [u8] {
        self.colors.as_flattened_mut()
    }

    /// All of it in one colour.
    pub fn clear(&mut self, color: Color) {
        self.colors.fill(color);
    }

    fn height(&self) -> usize {
        self.colors.len() / self.width
    }

    fn rows(&mut self) -> impl Iterator<Item = &mut [Color]> {
        self.colors.chunks_exact_mut(self.width)
    }
}

/// A whole pixel, as a share.
const WHOLE: u32 = 256;

/// Covers a share of a pixel, 0 to [`WHOLE`].
#[inline]
fn cover(pixel: &mut Color, color: Color, share: u32) {
    let [from, to] = [*pixel, color].map(u32::from_le_bytes);
    // Two channels at once, each in 16 bits.
    let mix = |shift: u32| {
        let [from, to] = [from, to].map(|c| c >> shift & 0x00ff_00ff);
        ((from * (WHOLE - share) + to * share + 0x0080_0080) >> 8 & 0x00ff_00ff) << shift
    };
    *pixel = (mix(0) | mix(8)).to_le_bytes();
}
