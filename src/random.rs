//! Addressable randomness: a stream of random numbers is a pure function of (seed, purpose, step, slot).
//!
//! A generator carried inside a particle would be cloned with it at a resampling, and every copy would draw the same
//! noise: the copies would never part. So there is no generator to carry. Noise is read from the stream at an
//! address, and two filters that read from the same address see the same noise, whatever else they do. So filters compared on
//! one figure share their world, and the order in which threads reach the particles does not matter.

use crate::ops;
use core::convert::Infallible;
use rand::{RngExt, TryRng};
use rand_pcg::Pcg64;

/// What a stream is drawn for: streams of different purposes are independent.
///
/// A filter takes [`PROPOSAL`](Self::PROPOSAL) and [`RESAMPLING`](Self::RESAMPLING), a smoother [`SMOOTHING`](Self::SMOOTHING) as well. Whoever
/// simulates its world takes others of their own, by [`Purpose::new`].
#[derive(Clone, Copy, PartialEq, Eq, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Purpose(u64);

impl Purpose {
    /// What a proposal draws for one particle in one step.
    pub const PROPOSAL: Self = Self(3);
    /// What a resampling draws.
    pub const RESAMPLING: Self = Self(4);
    /// Draws of tests and of experiments about the filters.
    pub const TRIAL: Self = Self(5);
    /// What a smoother draws for the path that it is given.
    pub const SMOOTHING: Self = Self(6);

    /// A purpose of one's own; 3 to 6 are those above.
    pub const fn new(number: u64) -> Self {
        Self(number)
    }
}

/// A stream of random numbers at one address.
///
/// PCG-XSL-RR 128/64 (O'Neill 2014) of `rand_pcg`; the address is hashed into both its state and its stream number.
///
/// A stream is a generator of [`rand`], by its traits [`TryRng`] and so [`rand::Rng`]: any distribution can draw from it. How many
/// `u64`s that takes, and whether the same bits come out on every platform, is then the distribution's matter: those with
/// logarithms and the like of the standard library differ from one to the other.
///
/// ```
/// use fastslam::random::{Purpose, Stream};
/// use fastslam::rand::distr::{Bernoulli, Distribution, Uniform};
/// use fastslam::rand::seq::SliceRandom;
///
/// const OUTLIERS: Purpose = Purpose::new(100);
/// let mut stream = Stream::at(1, OUTLIERS, 0, 0);
/// let range = Uniform::new(0.5, 8.0)?.sample(&mut stream);
/// assert!((0.5..8.0).contains(&range));
/// let struck = Bernoulli::new(0.05)?.sample_iter(&mut stream).take(1000).filter(|hit| *hit).count();
/// assert!((20..80).contains(&struck));
/// let mut order = [0, 1, 2, 3];
/// order.shuffle(&mut stream);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug)]
pub struct Stream(Pcg64);

impl Stream {
    /// The stream of `purpose` at `step` for `slot` under `seed`.
    pub fn at(seed: u64, purpose: Purpose, step: u32, slot: u32) -> Self {
        let address = (u64::from(step) << 32) | u64::from(slot);
        let mut hash = Hash(seed);
        hash.absorb(purpose.0);
        hash.absorb(address);
        let state = (u128::from(hash.squeeze()) << 64) | u128::from(hash.squeeze());
        let stream = (u128::from(hash.squeeze()) << 64) | u128::from(hash.squeeze());
        Self(Pcg64::new(state, stream))
    }

    /// Uniform on [0, 1), 53 bits; takes one `u64`.
    pub fn uniform(&mut self) -> f64 {
        self.0.random()
    }

    /// Standard normal by Box and Muller (1958), the cosine half only; always takes two `u64`s.
    pub fn normal(&mut self) -> f64 {
        let radius = (-2.0 * ops::ln(1.0 - self.uniform())).sqrt();
        radius * ops::cos(core::f64::consts::TAU * self.uniform())
    }

    /// `N` independent standard normals; takes 2 N `u64`s.
    pub fn normals<const N: usize>(&mut self) -> [f64; N] {
        core::array::from_fn(|_| self.normal())
    }

    /// Independent normals of these standard deviations; takes 2 N `u64`s. One without any is 0, and costs no logarithm.
    pub fn noise<const N: usize>(&mut self, stds: [f64; N]) -> [f64; N] {
        stds.map(|std| {
            if std == 0.0 {
                let _ = (self.uniform(), self.uniform());
                return 0.0;
            }
            std * self.normal()
        })
    }
}

impl TryRng for Stream {
    type Error = Infallible;

    fn try_next_u32(&mut self) -> Result<u32, Infallible> {
        self.0.try_next_u32()
    }

    fn try_next_u64(&mut self) -> Result<u64, Infallible> {
        self.0.try_next_u64()
    }

    fn try_fill_bytes(&mut self, bytes: &mut [u8]) -> Result<(), Infallible> {
        self.0.try_fill_bytes(bytes)
    }
}

/// SplitMix64 (Steele, Lea, Flood 2014) as a small hash: absorb words, squeeze words.
struct Hash(u64);

impl Hash {
    fn absorb(&mut self, word: u64) {
        self.0 = self.squeeze() ^ word;
    }

    fn squeeze(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_are_stable_across_versions() {
        let mut stream = Stream::at(3, Purpose::PROPOSAL, 7, 11);
        assert_eq!(stream.uniform().to_bits(), 0x3fae_3b78_09f5_7d80);
        assert_eq!(stream.normal().to_bits(), 0x3fea_3a43_80d1_bddb);
    }

    /// What is drawn through the traits and by the stream's own functions comes from one sequence.
    #[test]
    fn noise_is_normals_times_their_deviations_and_goes_on_where_they_would() {
        let stream = || Stream::at(7, Purpose::PROPOSAL, 3, 5);
        let (mut scaled, mut plain) = (stream(), stream());
        let [a, _, c] = plain.normals();
        assert_eq!(scaled.noise([0.5, 0.0, 2.0]), [0.5 * a, 0.0, 2.0 * c]);
        assert_eq!(scaled.uniform(), plain.uniform());
    }

    #[test]
    fn as_a_generator_of_rand_it_gives_its_own_numbers() {
        let [mut own, mut generator] = [(); 2].map(|()| Stream::at(3, Purpose::PROPOSAL, 7, 11));
        for _ in 0..9 {
            // The upper 53 bits of a `u64`.
            let expected = (rand::Rng::next_u64(&mut generator) >> 11) as f64 / (1_u64 << 53) as f64;
            assert_eq!(own.uniform(), expected);
        }
        let mut bytes = [0; 8];
        rand::Rng::fill_bytes(&mut own, &mut bytes);
        assert_eq!(u64::from_le_bytes(bytes), rand::Rng::next_u64(&mut generator));
    }

    /// n = 40 000 addresses, each against its neighbours of five kinds, the first draw of the one against the first and the second
    /// of the other. Independent pairs fall evenly into 8 × 8 fields: χ² of 63 degrees of freedom is below 123 with α = 1e-5, for
    /// each of ten.
    #[test]
    fn draws_at_neighbouring_addresses_are_independent() {
        const SIDE: usize = 8;
        type Neighbour<'a> = &'a dyn Fn(u64, u32, u32) -> [f64; 2];
        let draws = |seed, purpose, step, slot| {
            let mut stream = Stream::at(seed, purpose, step, slot);
            [stream.uniform(), stream.uniform()]
        };
        let purpose = Purpose::PROPOSAL;
        let neighbours: [(&str, Neighbour<'_>); 5] = [
            ("seed", &|seed, step, slot| draws(seed + 1, purpose, step, slot)),
            ("purpose", &|seed, step, slot| draws(seed, Purpose::RESAMPLING, step, slot)),
            ("step", &|seed, step, slot| draws(seed, purpose, step + 1, slot)),
            ("slot", &|seed, step, slot| draws(seed, purpose, step, slot + 1)),
            ("step and slot", &|seed, step, slot| draws(seed, purpose, step + 1, slot.wrapping_sub(1))),
        ];
        for (kind, neighbour) in neighbours {
            let mut counts = [[[0_u32; SIDE]; SIDE]; 2];
            for k in 0..40_000 {
                let (seed, step, slot) = (u64::from(k / 20_000), k / 100 % 200, k % 100);
                let [own, _] = draws(seed, purpose, step, slot);
                let field = |x: f64| (x * SIDE as f64) as usize;
                for (counts, other) in counts.iter_mut().zip(neighbour(seed, step, slot)) {
                    counts[field(own)][field(other)] += 1;
                }
            }
            let expected = 40_000.0 / (SIDE * SIDE) as f64;
            for (draw, counts) in counts.iter().enumerate() {
                let off = |count: &u32| (f64::from(*count) - expected) * (f64::from(*count) - expected) / expected;
                let chi_squared: f64 = counts.iter().flatten().map(off).sum();
                assert!(chi_squared < 123.0, "{kind}, draw {draw} of the neighbour: χ² = {chi_squared}");
            }
        }
    }

    /// α = 0.001 two-sided on mean and variance, n = 40 000 streams of one draw each, as a filter uses them.
    #[test]
    fn first_draws_over_addresses_are_standard_normal() {
        let n = 40_000_u32;
        let draws: Vec<f64> =
            (0..n).map(|slot| Stream::at(9, Purpose::TRIAL, slot / 200, slot % 200).normal()).collect();
        let mean = draws.iter().sum::<f64>() / f64::from(n);
        let variance = draws.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>() / f64::from(n);
        let sigma = 1.0 / f64::from(n).sqrt();
        assert!(mean.abs() < 3.29 * sigma, "mean {mean}");
        assert!((variance - 1.0).abs() < 3.29 * sigma * 2.0_f64.sqrt(), "variance {variance}");
    }
}
