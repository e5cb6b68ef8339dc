//! The canvas itself: opaque RGBA bytes, and the two ways to change them.

use super::Rgb;

/// RGBA, row by row.
#[derive(Default)]
pub struct Pixels {
    size: [u32; 2],
    bytes: Vec<u8>,
}

impl Pixels {
    /// Columns and rows.
    pub fn size(&self) -> [u32; 2] {
        self.size
    }

    /// The bytes.
    pub fn bytes(&self) -> &[u8] {
        &self.bytes
    }

    /// Takes this size, and one colour everywhere.
    pub fn clear(&mut self, size: [u32; 2], [r, g, b]: Rgb) {
        self.size = size;
        self.bytes.resize(4 * size[0] as usize * size[1] as usize, 0);
        self.bytes.chunks_exact_mut(4).for_each(|pixel| pixel.copy_from_slice(&[r, g, b, 255]));
    }

    /// A part of a row, from one column up to another.
    pub fn row(&mut self, row: u32, from: u32, to: u32) -> &mut [u8] {
        let start = row as usize * self.size[0] as usize;
        &mut self.bytes[4 * (start + from as usize)..4 * (start + to as usize)]
    }

    /// Lays a colour of this opacity, 0 to 255, over a part of a row.
    pub fn blend(&mut self, row: u32, from: u32, to: u32, opacity: u8, [r, g, b]: Rgb) {
        if opacity == 0 || from >= to {
            return;
        }
        if opacity == 255 {
            self.row(row, from, to).chunks_exact_mut(4).for_each(|pixel| pixel.copy_from_slice(&[r, g, b, 255]));
            return;
        }
        let a = u32::from(opacity);
        for pixel in self.row(row, from, to).chunks_exact_mut(4) {
            for (under, over) in pixel.iter_mut().zip([r, g, b]) {
                // A division by 255, rounded, for all of 0 to 255².
                let x = u32::from(*under) * (255 - a) + u32::from(over) * a + 128;
                *under = ((x + (x >> 8)) >> 8) as u8;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_blend_is_rounded_to_the_nearest() {
        for under in 0..=255 {
            for opacity in 0..=255 {
                let mut pixels = Pixels::default();
                pixels.clear([1, 1], [under; 3]);
                pixels.blend(0, 0, 1, opacity, [200, 0, 255]);
                let exact = |over: f64| {
                    let t = f64::from(opacity) / 255.0;
                    ((1.0 - t) * f64::from(under) + t * over + 0.5).floor() as u8
                };
                assert_eq!(pixels.bytes(), [exact(200.0), exact(0.0), exact(255.0), 255]);
            }
        }
    }
}
