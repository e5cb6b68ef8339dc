//! Colours: one palette for each theme, and what each role means in it.
//!
//! Hues are told apart by readers with any colour vision (blue, magenta, orange and green differ in lightness too), and no
//! meaning hangs on hue alone: lines differ in dash and width, weights in width, extinction in its cross. The contrasts that
//! WCAG 2.2 asks for (4.5 for text, 3 for marks) are tested below for every theme.

use crate::scene::{FREE, OCCUPIED, Role, SHARES, Shading, UNKNOWN};

/// Red, green and blue, 0 to 255.
pub type Rgb = [u8; 3];

/// Which palette.
#[derive(Clone, Copy, PartialEq, Eq, Debug, Default)]
pub enum Theme {
    /// Dark marks on white.
    #[default]
    Light,
    /// Light marks on near black.
    Dark,
    /// Light, for readers who asked for more contrast.
    ContrastLight,
    /// Dark, for readers who asked for more contrast.
    ContrastDark,
}

struct Palette {
    paper: Rgb,
    ink: Rgb,
    muted: Rgb,
    frame: Rgb,
    path: Rgb,
    truth: Rgb,
    raw: Rgb,
    copied: Rgb,
    extinct: Rgb,
    hit: Rgb,
    /// Borders of weight nothing and of full weight.
    weight: [Rgb; 2],
    /// Cells surely free, never seen, surely occupied.
    cells: [Rgb; 3],
    /// A cell that is a wall in half of the maps.
    disagree: Rgb,
    prior: Rgb,
    /// Full correlation, and the peak of a density; without any, both are paper.
    correlation: Rgb,
    density: Rgb,
}

const LIGHT: Palette = Palette {
    paper: rgb(0xffffff),
    ink: rgb(0x15202b),
    muted: rgb(0x596573),
    frame: rgb(0xc9d0d8),
    path: rgb(0x0a62c4),
    truth: rgb(0xb0266f),
    raw: rgb(0xa64f00),
    copied: rgb(0x5a3fc0),
    extinct: rgb(0xa8281e),
    hit: rgb(0xffffff),
    weight: [rgb(0x8a95a1), rgb(0x007c45)],
    cells: [rgb(0xffffff), rgb(0xd5dbe2), rgb(0x2a3644)],
    disagree: rgb(0xe39b00),
    prior: rgb(0xc85500),
    correlation: rgb(0x0b2f6b),
    density: rgb(0xdde5ee),
};

const DARK: Palette = Palette {
    paper: rgb(0x12161c),
    ink: rgb(0xeef2f6),
    muted: rgb(0xa9b4c0),
    frame: rgb(0x3c4653),
    path: rgb(0x6ab7ff),
    truth: rgb(0xf593c8),
    raw: rgb(0xf0a35a),
    copied: rgb(0xbda6ff),
    extinct: rgb(0xff8a7d),
    hit: rgb(0x12161c),
    weight: [rgb(0x66717e), rgb(0x3ddc97)],
    cells: [rgb(0x12161c), rgb(0x343d49), rgb(0xd3dbe4)],
    disagree: rgb(0xc98a10),
    prior: rgb(0xff9f45),
    correlation: rgb(0xa9d6ff),
    density: rgb(0x2b3542),
};

const CONTRAST_LIGHT: Palette = Palette {
    paper: rgb(0xffffff),
    ink: rgb(0x000000),
    muted: rgb(0x2e3640),
    frame: rgb(0x5c6670),
    path: rgb(0x0036a8),
    truth: rgb(0x8a0050),
    raw: rgb(0x6e3400),
    copied: rgb(0x3d1fa3),
    extinct: rgb(0x8c0d05),
    hit: rgb(0xffffff),
    weight: [rgb(0x6b7580), rgb(0x00562f)],
    cells: [rgb(0xffffff), rgb(0xb9c0c8), rgb(0x000000)],
    disagree: rgb(0xc27c00),
    prior: rgb(0x8a3c00),
    correlation: rgb(0x00122e),
    density: rgb(0xd3dbe4),
};

const CONTRAST_DARK: Palette = Palette {
    paper: rgb(0x000000),
    ink: rgb(0xffffff),
    muted: rgb(0xd5dce4),
    frame: rgb(0x8f9aa6),
    path: rgb(0x8ccaff),
    truth: rgb(0xffb0db),
    raw: rgb(0xffbe7a),
    copied: rgb(0xd6c8ff),
    extinct: rgb(0xffaaa0),
    hit: rgb(0x000000),
    weight: [rgb(0x8a959f), rgb(0x5cffb0)],
    cells: [rgb(0x000000), rgb(0x46505b), rgb(0xffffff)],
    disagree: rgb(0xd99600),
    prior: rgb(0xffb35c),
    correlation: rgb(0xeaf5ff),
    density: rgb(0x2f3945),
};

const fn rgb(hex: u32) -> Rgb {
    [(hex >> 16) as u8, (hex >> 8) as u8, hex as u8]
}

/// Between two colours, `t` from 0 to `full`, in whole numbers.
fn mix(a: Rgb, b: Rgb, t: i32, full: i32) -> Rgb {
    [0, 1, 2].map(|k| {
        let (a, b) = (i32::from(a[k]), i32::from(b[k]));
        (a + ((b - a) * t * 2 + full * (b - a).signum()) / (2 * full)) as u8
    })
}

impl Theme {
    /// By the name that the page uses; light for any other.
    pub fn named(name: &str) -> Self {
        match name {
            "dark" => Self::Dark,
            "contrast-light" => Self::ContrastLight,
            "contrast-dark" => Self::ContrastDark,
            _ => Self::Light,
        }
    }

    fn palette(self) -> &'static Palette {
        match self {
            Self::Light => &LIGHT,
            Self::Dark => &DARK,
            Self::ContrastLight => &CONTRAST_LIGHT,
            Self::ContrastDark => &CONTRAST_DARK,
        }
    }

    /// The colour of a role.
    pub fn color(self, role: Role) -> Rgb {
        let palette = self.palette();
        match role {
            Role::Paper => palette.paper,
            Role::Ink | Role::Variant(0) => palette.ink,
            Role::Muted => palette.muted,
            Role::Frame => palette.frame,
            Role::Raw | Role::Variant(1) => palette.raw,
            Role::Path | Role::Posterior | Role::Series(0) | Role::Variant(_) => palette.path,
            Role::Truth | Role::Feature => palette.truth,
            Role::Copied => palette.copied,
            // Five hues in turn: what is off by one is never taken for its neighbour.
            Role::Class(rank) => {
                [palette.path, palette.weight[1], palette.copied, palette.extinct, palette.ink][usize::from(rank % 5)]
            }
            Role::Extinct => palette.extinct,
            Role::Fading(level) => mix(palette.paper, palette.extinct, i32::from(level), 255),
            Role::Hit => palette.hit,
            Role::Weight(level) => mix(palette.weight[0], palette.weight[1], i32::from(level), 255),
            Role::Prior | Role::Series(_) => palette.prior,
            Role::Accent => palette.weight[1],
            // Even the faintest is seen to be there.
            Role::Level(level) => mix(palette.paper, palette.ink, 40 + i32::from(level), 40 + 255),
        }
    }

    /// The colours of all shades of a cell.
    pub fn shades(self, shading: Shading) -> [Rgb; 256] {
        let palette = self.palette();
        core::array::from_fn(|shade| {
            let shade = shade as i32;
            match shading {
                Shading::Map => palette.cell(shade),
                Shading::Ghost => mix(palette.cell(shade), palette.paper, 45, 100),
                Shading::Share => palette.share(shade),
                Shading::Correlation => mix(palette.paper, palette.correlation, shade, 255),
                Shading::Density => mix(palette.paper, palette.density, shade, 255),
                Shading::Glaze => palette.raw,
            }
        })
    }
}

impl Palette {
    /// A cell of a map.
    fn cell(&self, shade: i32) -> Rgb {
        let [free, unknown, occupied] = self.cells;
        let middle = i32::from(UNKNOWN);
        if shade < middle {
            mix(free, unknown, shade - i32::from(FREE), middle - i32::from(FREE))
        } else {
            mix(unknown, occupied, shade - middle, i32::from(OCCUPIED) - middle)
        }
    }
}

impl Palette {
    /// A cell of many maps.
    fn share(&self, shade: i32) -> Rgb {
        let ([free, unknown, wall], least) = (self.cells, i32::from(SHARES));
        if shade < least {
            return mix(free, unknown, shade, least - 1);
        }
        let p = f64::from(shade - least) / f64::from(255 - least);
        // Square roots: that one map differs must be seen.
        let doubt = |share: f64| ((2.0 * share).sqrt() * 1000.0) as i32;
        if p < 0.5 { mix(free, self.disagree, doubt(p), 1000) } else { mix(wall, self.disagree, doubt(1.0 - p), 1000) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const THEMES: [Theme; 4] = [Theme::Light, Theme::Dark, Theme::ContrastLight, Theme::ContrastDark];

    /// Relative luminance of WCAG 2.2.
    fn luminance(color: Rgb) -> f64 {
        let [r, g, b] = color.map(|c| {
            let c = f64::from(c) / 255.0;
            if c <= 0.040_45 { c / 12.92 } else { libm::exp(2.4 * libm::log((c + 0.055) / 1.055)) }
        });
        0.2126 * r + 0.7152 * g + 0.0722 * b
    }

    fn contrast(a: Rgb, b: Rgb) -> f64 {
        let (a, b) = (luminance(a), luminance(b));
        (a.max(b) + 0.05) / (a.min(b) + 0.05)
    }

    #[test]
    fn text_has_the_contrast_of_wcag_aa_and_in_contrast_themes_of_aaa() {
        for theme in THEMES {
            let least = if matches!(theme, Theme::Light | Theme::Dark) { 4.5 } else { 7.0 };
            let policies = [0, 1, 2].map(Role::Variant).into_iter().chain((0..7).map(Role::Class));
            for role in [Role::Ink, Role::Muted, Role::Copied, Role::Extinct, Role::Path].into_iter().chain(policies) {
                let ratio = contrast(theme.color(role), theme.color(Role::Paper));
                assert!(ratio >= least, "{theme:?} {role:?}: {ratio}");
            }
        }
    }

    #[test]
    fn lines_stand_out_from_paper_free_and_unknown_cells() {
        for theme in THEMES {
            let shades = theme.shades(Shading::Map);
            for role in [Role::Path, Role::Truth, Role::Raw, Role::Weight(255)] {
                for ground in [theme.color(Role::Paper), shades[usize::from(FREE)], shades[usize::from(UNKNOWN)]] {
                    let ratio = contrast(theme.color(role), ground);
                    assert!(ratio >= 3.0, "{theme:?} {role:?}: {ratio}");
                }
            }
            for role in [Role::Weight(0), Role::Weight(128)] {
                let ratio = contrast(theme.color(role), theme.color(Role::Paper));
                assert!(ratio >= 3.0, "{theme:?} {role:?}: {ratio}");
            }
        }
    }

    #[test]
    fn walls_stand_out_from_free_and_unknown_cells_and_their_hits_from_walls() {
        for theme in THEMES {
            let shades = theme.shades(Shading::Map);
            let [free, unknown, occupied] = [FREE, UNKNOWN, OCCUPIED].map(|s| shades[usize::from(s)]);
            assert!(contrast(occupied, free) >= 7.0, "{theme:?}");
            assert!(contrast(occupied, unknown) >= 4.5, "{theme:?}");
            assert!(contrast(theme.color(Role::Hit), occupied) >= 4.5, "{theme:?}");
            assert!(contrast(free, unknown) >= 1.3, "{theme:?}");
        }
    }

    #[test]
    fn disagreement_is_no_wall_nothing_free_and_nothing_unknown() {
        for theme in THEMES {
            let shades = theme.shades(Shading::Share);
            let [free, unknown, wall, half] = [0, SHARES - 1, 255, 160].map(|shade| shades[usize::from(shade)]);
            let map = theme.shades(Shading::Map);
            assert_eq!(
                [free, unknown, wall],
                [FREE, UNKNOWN, OCCUPIED].map(|shade| map[usize::from(shade)]),
                "{theme:?}"
            );
            for other in [free, unknown, wall] {
                let ratio = contrast(half, other);
                assert!(ratio >= 1.6, "{theme:?} {other:?}: {ratio}");
            }
            // One map of sixteen that has a wall where the others have none, and the other way round.
            for (one, all) in [(SHARES + 12, free), (255 - 12, wall)] {
                let ratio = contrast(shades[usize::from(one)], all);
                assert!(ratio >= 1.15, "{theme:?} {one}: {ratio}");
            }
        }
    }

    #[test]
    fn samples_and_handles_are_seen_on_every_density() {
        for theme in THEMES {
            for ground in theme.shades(Shading::Density) {
                for role in [Role::Prior, Role::Posterior, Role::Feature, Role::Accent, Role::Muted, Role::Ink] {
                    let ratio = contrast(theme.color(role), ground);
                    assert!(ratio >= 3.0, "{theme:?} {role:?}: {ratio}");
                }
            }
            let [nothing, .., peak] = theme.shades(Shading::Density);
            assert!(contrast(nothing, peak) >= 1.2, "{theme:?}");
        }
    }

    #[test]
    fn stronger_correlations_stand_out_more_from_paper() {
        for theme in THEMES {
            let paper = theme.color(Role::Paper);
            let lines: Vec<Rgb> = (0..=255).map(|level| theme.color(Role::Level(level))).collect();
            for colors in [theme.shades(Shading::Correlation).to_vec(), lines] {
                let contrasts: Vec<f64> = colors.iter().map(|&color| contrast(color, paper)).collect();
                // Every eighth is told apart from the one before, and the last is as strong as text.
                let eighths: Vec<f64> = contrasts.iter().step_by(32).copied().collect();
                assert!(eighths.windows(2).all(|pair| pair[1] > 1.1 * pair[0]), "{theme:?} {eighths:?}");
                assert!(contrasts[255] >= 7.0, "{theme:?}: {}", contrasts[255]);
            }
            assert_eq!(theme.shades(Shading::Correlation)[0], paper);
            assert_eq!(theme.color(Role::Level(255)), theme.color(Role::Ink));
        }
    }

    #[test]
    fn the_ends_of_a_mix_are_its_colours() {
        let (a, b) = (rgb(0x102030), rgb(0xf0e000));
        assert_eq!((mix(a, b, 0, 255), mix(a, b, 255, 255)), (a, b));
    }
}
