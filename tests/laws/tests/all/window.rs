//! Laws of the proposal that draws late: between FastSLAM 2.0, of which it is a case, and the joint filter, which it is as long as nothing is drawn.

use fastslam::execute::Executor;
use fastslam::geometry::Pose2;
use fastslam::laws::linear::{self, Drift, Exact, Offset};
use fastslam::map::landmarks::{Correspondence, Gate, Landmarks};
use fastslam::motion::{Motion, Velocity, VelocityModel};
use fastslam::ops;
use fastslam::particle::Particle;
use fastslam::proposal::{FromMeasurement, FromWindow, Proposal, Windowed};
use fastslam::random::{Purpose, Stream};
use fastslam::rbpf::Rbpf;
use fastslam::resampling::ResamplePolicy;
use fastslam::sensor::{Feature, RangeBearing};
use fastslam_lab::baseline::EkfSlam;
use fastslam_lab::experiment::car;
use fastslam_lab::experiment::landmarks::Course;
use nalgebra::Vector3;

fn linear_map() -> Windowed<Offset, Vector3<f64>> {
    Windowed::new(Landmarks::new(Offset, Correspondence::Known))
}

/// One particle that draws nothing, in worlds that are not linear, with known and with unknown correspondence: every mean and every step's evidence.
/// The two are written apart, and differ in the order of their sums.
#[test]
fn as_long_as_nothing_is_drawn_a_particle_is_the_joint_filter() {
    let (car, eight) = (car::tuning(), Course::Eight.tuning());
    let (driven, course) = (car::simulate(1), Course::Eight.simulate(1));
    for correspondence in [Correspondence::Known, Correspondence::Unknown(Gate::default())] {
        alike(car.motion, car.sensor, correspondence, &driven.controls, &driven.sightings);
        alike(eight.motion, eight.sensor, correspondence, &course.controls, &course.sightings);
    }
}

fn alike<D: Motion<Control = Velocity> + Clone>(
    motion: D,
    sensor: RangeBearing,
    correspondence: Correspondence,
    controls: &[Velocity],
    sightings: &[Vec<Feature>],
) {
    let mut joint = EkfSlam::new(motion.clone(), sensor, correspondence, Pose2::default());
    let map = <Windowed<_, _>>::new(Landmarks::new(sensor, correspondence));
    let proposal = FromWindow { motion, drawn: 1000, ahead: 0 };
    let mut filter = Rbpf::builder(map, proposal).particles(1).build().unwrap();
    let mut again = 0;
    for (control, features) in controls.iter().zip(sightings).take(40) {
        let (exact, report) = (joint.step(control, features), filter.step(control, features));
        assert_eq!(report.associations[0].associations, exact.associations, "step {}", report.step);
        let difference = filter.particles()[0].world_from_robot.minus(joint.pose()).norm();
        let evidence = (report.log_evidence - exact.log_evidence).abs();
        assert!(difference < 1e-8 && evidence < 1e-6, "step {}: {difference} {evidence}", report.step);
        again += usize::from(exact.log_evidence != 0.0);
    }
    assert!(again > 20, "{again} steps saw a landmark again");
    let map = &filter.particles()[0].map;
    assert_eq!((map.undrawn(), map.path().len(), map.landmarks().iter().count()), (40, 41, 0));
}

/// Price, draw and landmarks, particle by particle, where each step is drawn as soon as it is seen.
#[test]
fn one_step_at_a_time_with_none_ahead_is_fastslam_2() {
    let mut late = Rbpf::builder(linear_map(), FromWindow { motion: Drift, drawn: 1, ahead: 0 })
        .particles(8)
        .policy(ResamplePolicy::EssBelow(0.9))
        .build()
        .unwrap();
    let map = <Landmarks<_>>::new(Offset, Correspondence::Known);
    let mut two = Rbpf::builder(map, FromMeasurement { motion: Drift })
        .particles(8)
        .policy(ResamplePolicy::EssBelow(0.9))
        .build()
        .unwrap();
    let mut resampled = 0;
    for (u, features) in linear::drive(2) {
        let (a, b) = (late.step(&u, &features), two.step(&u, &features));
        resampled += usize::from(b.resampled());
        assert_eq!(a.ancestors, b.ancestors);
        for (slot, (one, other)) in a.log_increments.iter().zip(&b.log_increments).enumerate() {
            assert!((one - other).abs() < 1e-9, "step {}, slot {slot}: {one} {other}", a.step);
        }
        for (one, other) in late.particles().iter().zip(two.particles()) {
            let path = one.map.path();
            assert!(path[path.len() - 1].minus(&other.world_from_robot).norm() < 1e-9);
            for (index, landmark) in other.map.iter() {
                assert!((one.map.landmarks().get(index).unwrap().mean - landmark.mean).norm() < 1e-9);
            }
        }
    }
    assert!(resampled > 0, "the ancestors were compared");
}

/// E p̂(z₁..T) = p(z₁..T), and E p̂(z₁..T) x̂_T = p(z₁..T) E(x_T | z₁..T): products of means, which have no bias however few the particles are.
///
/// n = 10 000 filters of 2 particles, 4.5 standard errors for each of 12 numbers: α = 7 · 10⁻⁶ each. Not vacuous: draws scatter the evidence, so that the
/// mean of its logarithms, which has a bias, is told from that of the joint filter.
#[test]
fn evidence_and_pose_have_no_bias_where_all_is_linear() {
    const N: u32 = 10_000;
    let (exact, log) = (Exact::after(2), linear::drive(2));
    let mean = Pose2::new(exact.mean[0], exact.mean[1], exact.mean[2]);
    for [drawn, ahead] in [[1, 0], [1, 1], [2, 1]] {
        let of = |seed| {
            let mut filter = Rbpf::builder(linear_map(), FromWindow { motion: Drift, drawn, ahead })
                .particles(2)
                .seed(seed)
                .policy(ResamplePolicy::EssBelow(0.9))
                .executor(Executor::Serial)
                .build()
                .unwrap();
            let log_evidence: f64 = log.iter().map(|(u, features)| filter.step(u, features).log_evidence).sum();
            let log_ratio = log_evidence - exact.log_evidence;
            let weighted = filter.particles().iter().zip(filter.weights().as_slice());
            let error: Vector3<f64> = weighted.map(|(p, w)| p.world_from_robot.minus(&mean) * *w).sum();
            let ratio = ops::exp(log_ratio);
            [ratio - 1.0, ratio * error.x, ratio * error.y, ratio * error.z, log_ratio]
        };
        let all: Vec<[f64; 5]> = (0..N.into()).map(of).collect();
        let errors: [f64; 5] = core::array::from_fn(|k| {
            let mean = all.iter().map(|of| of[k]).sum::<f64>() / f64::from(N);
            let variance = all.iter().map(|of| (of[k] - mean) * (of[k] - mean)).sum::<f64>() / f64::from(N);
            mean / (variance / f64::from(N)).sqrt()
        });
        assert!(errors[..4].iter().all(|t| t.abs() < 4.5), "{drawn} drawn, {ahead} ahead: {errors:?} standard errors");
        assert!(errors[4] < -4.5, "{drawn} drawn, {ahead} ahead: the mean of logarithms is no lower: {errors:?}");
    }
}

/// The same noise, told later, scatters the price of the same landmarks less: what the lag is for.
#[test]
fn who_draws_later_pays_more_alike() {
    let log = linear::drive(2);
    let scatter = |drawn, ahead| {
        let of = |seed| {
            let proposal = FromWindow { motion: Drift, drawn, ahead };
            let mut filter = Rbpf::builder(linear_map(), proposal).particles(1).seed(seed).build().unwrap();
            log.iter().map(|(u, features)| filter.step(u, features).log_evidence).sum::<f64>()
        };
        let all: Vec<f64> = (0..2000).map(of).collect();
        let mean = all.iter().sum::<f64>() / 2000.0;
        all.iter().map(|of| (of - mean) * (of - mean)).sum::<f64>() / 2000.0
    };
    let [now, later, never] = [scatter(1, 0), scatter(1, 2), scatter(1, 4)];
    assert!(later < 0.5 * now && never < 1e-20, "{now} {later} {never}");
}

/// Features that say nothing, or nothing new, and a step without any.
#[test]
fn a_window_without_sightings_goes_by_the_wheels() {
    let motion = VelocityModel { speed_std: 0.1, turn_rate_std: 0.1, alphas: [0.0; 4] };
    let sensor = RangeBearing { range_std: 0.1, bearing_std: 0.02, max_range: 9.0, field_of_view: 7.0 };
    let map = <Windowed<_, _>>::new(Landmarks::new(sensor, Correspondence::Known));
    let proposal = FromWindow { motion, drawn: 2, ahead: 1 };
    let mut filter = Rbpf::builder(map, proposal).particles(5).build().unwrap();
    let unnamed = Feature { z: [2.0, 0.1].into(), signature: None };
    let ahead = Velocity { speed: 1.0, turn_rate: 0.0, duration: 1.0 };
    for features in [vec![], vec![unnamed], vec![], vec![], vec![]] {
        assert_eq!(filter.step(&ahead, &features).log_increments, [0.0; 5]);
    }
    let ends: Vec<f64> = filter.particles().iter().map(|p| p.world_from_robot.x).collect();
    assert!(ends.iter().all(|x| (x - 5.0).abs() < 2.0) && ends.iter().any(|x| *x != ends[0]), "{ends:?}");
}

#[test]
fn one_stream_gives_one_draw() {
    let proposal = FromWindow { motion: Drift, drawn: 1, ahead: 0 };
    let (u, features) = linear::drive(2).remove(0);
    let particle = Particle::start(Pose2::default(), linear_map());
    let drawn = |slot| {
        let proposed = proposal.propose(&particle, &u, &features, &mut Stream::at(1, Purpose::TRIAL, 0, slot));
        let mut map = particle.map.clone();
        fastslam::map::ConditionalMap::assimilate(
            &mut map,
            &proposed.world_from_robot,
            &features,
            &proposed.association,
        );
        map.path()
    };
    assert!(drawn(0) == drawn(0) && drawn(0) != drawn(1));
}

#[test]
fn a_window_out_of_range_is_refused_by_name() {
    let refused = |drawn, ahead| {
        let built = Rbpf::builder(linear_map(), FromWindow { motion: Drift, drawn, ahead }).build();
        built.err().map(|error| error.to_string())
    };
    assert_eq!(refused(0, 3).unwrap(), "drawn = 0: must be a whole number from 1 to 1000");
    assert_eq!(refused(1, 1001).unwrap(), "ahead = 1001: must be a whole number from 0 to 1000");
    assert_eq!(refused(1, 0), None);
}
