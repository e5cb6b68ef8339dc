//! One run: what it prints of its errors, and of every step for programs.

use super::{Arguments, Others, Steps, drift_row, innovation_row, outcome, say};
use crate::remarks::Outcome;
use crate::settings::Adjust;
use crate::{picture, print, print_json};
use anyhow::Result;
use fastslam::motion::Motion;
use fastslam_lab::experiment::innovations::{Innovations, Predicts};
use fastslam_lab::experiment::landmarks::{LandmarkReport, LandmarkRun, WithLandmarks};
use serde::Serialize;

/// What `--json` prints of one run.
#[derive(Serialize)]
struct Output {
    /// Where the noises that the filters are told come from.
    noises: String,
    /// Of the best particle's path at the end \[m\].
    rms_best: f64,
    /// \[m\]
    rms_best_aligned: f64,
    /// \[m\]
    rms_odometry: f64,
    /// RMS over the steps of the errors of the weighted mean, each when it was made \[m\].
    rms_online: f64,
    /// The same of EKF-SLAM on the same drive \[m\].
    rms_ekf: f64,
    /// The same of FastSLAM 2.0 that draws late \[m\].
    #[serde(skip_serializing_if = "Option::is_none")]
    rms_late: Option<f64>,
    /// In the best particle's map.
    landmarks: u32,
    /// What the robot turns to the left beyond its odometry, per metre ahead \[rad/m\] and per radian turned \[–\], where that is learnt.
    drift: Option<[f64; 2]>,
    /// Mean normalised innovation squared; 2 is expected.
    innovation: Option<f64>,
    /// What speaks against the result, with what to change.
    remarks: Vec<String>,
    /// Share of the steps that resampled.
    resampled_fraction: f64,
    map_bytes_unique: u64,
    map_bytes_dense: u64,
    steps: Vec<LandmarkReport>,
}

/// Runs the filter, and prints how far off it was.
pub(super) fn one<D, M, P>(
    arguments: &Arguments,
    mut run: LandmarkRun<D, M, P>,
    others: Others,
    (noises, of_log): (&str, &[String]),
) -> Result<()>
where
    D: Motion + Adjust + Clone,
    M: WithLandmarks,
    P: Predicts<M, Control = D::Control>,
{
    let (mut steps, mut innovations) = (Vec::new(), Innovations::default());
    while let Some(report) = innovations.step(&mut run) {
        steps.push(report);
    }
    if let Some(path) = &arguments.png {
        picture::save(&picture::of_landmarks(&run), path)?;
    }
    let footprint = run.footprint();
    let resampled = steps.iter().filter(|step| step.ancestors.is_some()).count();
    let mut counted = Steps::default();
    steps.iter().for_each(|step| counted.add(step));
    let outcome = Outcome { ekf: others.ekf, excess: others.excess, ..outcome(&run, &innovations, counted) };
    let remarks = [of_log, &outcome.remarks(D::NAMES)].concat();
    let output = Output {
        noises: noises.into(),
        rms_best: run.rms_best(),
        rms_best_aligned: run.rms_best_aligned(),
        rms_odometry: run.rms_odometry(),
        rms_online: run.rms_online(),
        rms_ekf: others.ekf,
        rms_late: others.late,
        landmarks: outcome.left as u32,
        drift: outcome.drift,
        innovation: innovations.mean(),
        remarks,
        resampled_fraction: resampled as f64 / steps.len().max(1) as f64,
        map_bytes_unique: footprint.unique,
        map_bytes_dense: footprint.dense,
        steps,
    };
    say(&output.remarks);
    if arguments.json {
        return print_json(&output);
    }
    let late =
        output.rms_late.map(|late| format!("the same, where poses are drawn late{late:6.3} m\n")).unwrap_or_default();
    print(&format!(
        "{} steps, {} particles; noises {noises}\n\
         RMS error as it went, of the mean {:8.3} m, of EKF-SLAM {:.3} m\n\
         {late}\
         the best path at the end          {:8.3} m\n\
         the same after rigid alignment    {:8.3} m\n\
         raw odometry                      {:8.3} m\n\
         landmarks in the best map         {:8} (there are {})\n\
         {}\
         {}\
         steps that resampled              {:8.0} %\n\
         maps                              {:8.1} kB, {:.1} kB as dense copies\n",
        output.steps.len(),
        arguments.particles,
        output.rms_online,
        output.rms_ekf,
        output.rms_best,
        output.rms_best_aligned,
        output.rms_odometry,
        output.landmarks,
        run.log().landmarks.len(),
        drift_row(output.drift),
        innovation_row(output.innovation),
        100.0 * output.resampled_fraction,
        output.map_bytes_unique as f64 / 1e3,
        output.map_bytes_dense as f64 / 1e3,
    ))
}
