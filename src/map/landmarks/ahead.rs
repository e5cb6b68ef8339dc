//! Log-likelihoods of a sequence of observations along one path, for many maps at once: each landmark is filtered by itself, and once for all
//! maps in which its Gaussian is the same.
//!
//! Given the path, landmarks are independent, so that the likelihood of a sequence is a product over landmarks. Particles with a common ancestor
//! share most of their landmarks, and a landmark that was not observed yet is new to all of them.

use super::{Correspondence, Landmark, Landmarks, Store, association};
use crate::execute::Executor;
use crate::geometry::Pose2;
use crate::sensor::{Feature, LandmarkSensor};
use core::borrow::Borrow;
use nalgebra::Vector2;

/// All observations of one landmark along the path.
struct Track {
    index: u32,
    /// Number of the observation among those of all landmarks, its step, and z.
    sightings: Vec<(usize, usize, Vector2<f64>)>,
}

/// Log-likelihoods of a track \[nats\] for maps that begin with the same Gaussian; `None` where an observation initializes the landmark, or its
/// innovation is singular.
struct Followed {
    from: Option<Landmark>,
    said: Vec<Option<f64>>,
}

impl<Z: LandmarkSensor, S: Store> Landmarks<Z, S> {
    /// ln p(z_t | x_t, m) \[nats\] of each observation from its pose, for each map, which is updated with every observation before the next.
    /// `None` where correspondence is unknown: then each map associates by itself.
    pub(crate) fn log_likelihoods_along(
        maps: &[&Self],
        path: &[Pose2],
        observations: &[impl Borrow<[Feature]>],
        executor: &Executor,
    ) -> Option<Vec<Vec<f64>>> {
        let Self { sensor, correspondence: Correspondence::Known, .. } = maps.first()? else { return None };
        let (mut tracks, mut counts, mut seen) = (Vec::<Track>::new(), Vec::new(), 0);
        for (step, features) in observations.iter().enumerate() {
            let features = features.borrow();
            let known = association::known(features, sensor);
            counts.push(known.len());
            for (k, index) in known {
                let sighting = (seen, step, features[k].z);
                seen += 1;
                match tracks.iter_mut().find(|track| track.index == index) {
                    Some(track) => track.sightings.push(sighting),
                    None => tracks.push(Track { index, sightings: vec![sighting] }),
                }
            }
        }
        let followed = executor.map(&mut tracks, |_, track| track.follow(maps, path));
        let mut said = vec![None; seen];
        let of_map = |map: usize| {
            for (track, (of, followed)) in tracks.iter().zip(&followed) {
                for ((number, ..), log) in track.sightings.iter().zip(&followed[of[map]].said) {
                    said[*number] = *log;
                }
            }
            let mut next = said.iter();
            let step = |count: &usize| next.by_ref().take(*count).flatten().fold(0.0, |sum, log| sum + log);
            counts.iter().map(step).collect()
        };
        Some((0..maps.len()).map(of_map).collect())
    }
}

impl Track {
    /// Filters the track once for each distinct Gaussian among the maps. Returns the index of each map's Gaussian, and the results by index.
    fn follow<Z: LandmarkSensor, S: Store>(
        &self,
        maps: &[&Landmarks<Z, S>],
        path: &[Pose2],
    ) -> (Vec<usize>, Vec<Followed>) {
        let mut followed = Vec::<Followed>::new();
        let of = |map: &&Landmarks<Z, S>| {
            let from = map.get(self.index);
            let known = followed.iter().position(|known| same(known.from.as_ref(), from));
            known.unwrap_or_else(|| {
                followed.push(Followed { from: from.copied(), said: self.said(from.copied(), &map.sensor, path) });
                followed.len() - 1
            })
        };
        (maps.iter().map(of).collect(), followed)
    }

    fn said(&self, mut landmark: Option<Landmark>, sensor: &impl LandmarkSensor, path: &[Pose2]) -> Vec<Option<f64>> {
        let say = |(_, step, z): &(usize, usize, Vector2<f64>)| match &mut landmark {
            None => {
                landmark = Some(Landmark::first(sensor, &path[*step], z));
                None
            }
            Some(landmark) => {
                let innovation = landmark.innovation(sensor, &path[*step], z);
                landmark.take_in(sensor, &innovation).then(|| innovation.log_likelihood())
            }
        };
        self.sightings.iter().map(say).collect()
    }
}

/// Whether mean and covariance of two landmarks are equal to the bit.
fn same(one: Option<&Landmark>, other: Option<&Landmark>) -> bool {
    let (Some(one), Some(other)) = (one, other) else { return one.is_none() && other.is_none() };
    let numbers = |landmark| {
        let Landmark { mean, covariance, .. }: &Landmark = landmark;
        [mean.x, mean.y, covariance.m11, covariance.m21, covariance.m12, covariance.m22]
    };
    numbers(one).iter().zip(&numbers(other)).all(|(a, b)| a.to_bits() == b.to_bits())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::map::ConditionalMap;
    use crate::map::landmarks::Gate;
    use crate::matching::Likelihood as _;
    use crate::proposal::Marginal;
    use crate::random::{Purpose, Stream};
    use crate::sensor::RangeBearing;

    type Map = Landmarks<RangeBearing>;

    const SENSOR: RangeBearing =
        RangeBearing { range_std: 0.2, bearing_std: 0.05, max_range: 10.0, field_of_view: core::f64::consts::TAU };

    fn feature(z: [f64; 2], signature: Option<u32>) -> Feature {
        Feature { z: z.into(), signature }
    }

    /// The same for one map by association and update, step by step.
    fn one_by_one(map: &Map, path: &[Pose2], log: &[Vec<Feature>]) -> Vec<f64> {
        let mut map = map.clone();
        let say = |(pose, features): (&Pose2, &Vec<Feature>)| {
            let (said, associations) = Marginal.log_likelihood(&map, pose, features);
            map.assimilate(pose, features, &associations);
            said
        };
        path.iter().zip(log).map(say).collect()
    }

    /// To the bit: for maps with equal, different and missing landmarks; with a landmark observed twice in a step, without a signature, and with
    /// measurements that no sensor gives.
    #[test]
    fn many_maps_say_together_what_each_says_by_itself() {
        let mut stream = Stream::at(4, Purpose::TRIAL, 0, 0);
        let path: Vec<Pose2> = (0..9).map(|k| Pose2::new(0.3 * f64::from(k), 0.05 * stream.normal(), 0.1)).collect();
        let mut see = |index: u32| feature([3.0 + 0.2 * stream.normal(), 0.4 * stream.normal()], Some(index));
        let log: Vec<Vec<Feature>> = (0..9)
            .map(|k| {
                let odd = [feature([2.0, 0.1], None), feature([f64::NAN, 0.1], Some(3)), feature([-1.0, 0.1], Some(4))];
                [see(k % 3), see(7), see(k % 5), see(40)].into_iter().chain(odd).collect()
            })
            .collect();
        let begun = |features: &[Feature], correspondence| {
            let mut map = Map::new(SENSOR, correspondence);
            for _ in 0..3 {
                let (_, associations) = Marginal.log_likelihood(&map, &path[0], features);
                map.assimilate(&path[0], features, &associations);
            }
            map
        };
        let known = |features: &[Feature]| begun(features, Correspondence::Known);
        let shared = known(&log[0]);
        let maps = [&shared, &known(&log[1]), &shared.clone(), &known(&[]), &known(&log[0][..1])];
        let found = Map::log_likelihoods_along(&maps, &path, &log, &Executor::default()).unwrap();
        for (map, found) in maps.iter().zip(&found) {
            assert_eq!(found, &one_by_one(map, &path, &log));
        }
        assert!(found[0] != found[1] && found[0] == found[2] && found[0].iter().all(|said| said.is_finite()));
        // Data association needs the whole map.
        let unknown = begun(&log[0], Correspondence::Unknown(Gate::default()));
        assert_eq!(Map::log_likelihoods_along(&[&unknown], &path, &log, &Executor::default()), None);
    }
}
