//! What is told of the example in numbers and in words.

use super::{challenges, model::WorkedExampleModel};
use super::{recipe::plain, steps};
use crate::challenge::Challenge;
use crate::decimal::fixed;
use crate::model::{Column, Readout, Series, Tells, TraceLine};
use crate::told::{ess_text, pose_text};
use crate::words::{common, worked_example};
use fastslam::geometry::Pose2;
use fastslam_lab::experiment::worked_example::{Update, WorkedExample};

/// Significant digits of readouts: what a phone has room for.
const DIGITS: i32 = 7;

impl Tells for WorkedExampleModel {
    fn challenges() -> Vec<Challenge<Self>> {
        challenges::challenges()
    }

    fn readouts(&self) -> Vec<Readout> {
        let WorkedExample { updates: [one, two], weights, ess, resamples, .. } = &self.example;
        let density = |name, title, update: &Update| {
            let (x, help) = (update.weight, worked_example::density_help());
            Readout::new(name, title, x, plain(x, DIGITS), "/(m rad)", help)
        };
        let log = |name, title, update: &Update| {
            let (x, help) = (update.innovation.log_likelihood(), worked_example::log_help());
            Readout::new(name, title, x, plain(x, DIGITS), "nats", help)
        };
        let share = |name, title, slot: usize| {
            let (x, help) = (weights.as_slice()[slot], worked_example::share_help());
            Readout::new(name, title, x, plain(x, DIGITS), "", help)
        };
        vec![
            density("w1", worked_example::w1(), one),
            density("w2", worked_example::w2(), two),
            log("log_w1", worked_example::log_w1(), one),
            log("log_w2", worked_example::log_w2(), two),
            share("normalized1", worked_example::share1(), 0),
            share("normalized2", worked_example::share2(), 1),
            Readout::new(
                "ess",
                "N_eff",
                *ess,
                common::Of { n: &plain(*ess, DIGITS), all: &2 }.say(),
                "",
                worked_example::n_eff_help(),
            ),
            Readout::new(
                "verdict",
                worked_example::verdict(),
                f64::from(u8::from(*resamples)),
                self.verdict(),
                "",
                worked_example::verdict_help(),
            ),
        ]
    }

    fn series(&self) -> Series {
        const COLUMNS: &[Column] = &[
            Column::new("particle", "1 or 2; the last three columns tell of both"),
            Column::new("x_m", "its pose, x [m]"),
            Column::new("y_m", "its pose, y [m]"),
            Column::new("theta_rad", "its pose, direction [rad]"),
            Column::new("z_r_m", "measured range [m]"),
            Column::new("z_phi_rad", "measured bearing [rad]"),
            Column::new("mu_x_m", "landmark before, x [m]"),
            Column::new("mu_y_m", "landmark before, y [m]"),
            Column::new("sigma_xx_m2", "its covariance, xx [m²]"),
            Column::new("sigma_xy_m2", "its covariance, xy [m²]"),
            Column::new("sigma_yy_m2", "its covariance, yy [m²]"),
            Column::new("q_rr_m2", "variance of a measured range [m²]"),
            Column::new("q_phiphi_rad2", "variance of a measured bearing [rad²]"),
            Column::new("expected_r_m", "expected range [m]"),
            Column::new("expected_phi_rad", "expected bearing [rad]"),
            Column::new("nu_r_m", "innovation of the range [m]"),
            Column::new("nu_phi_rad", "innovation of the bearing [rad]"),
            Column::new("h_rx", "H_m: range by x"),
            Column::new("h_ry", "H_m: range by y"),
            Column::new("h_phix", "H_m: bearing by x [rad/m]"),
            Column::new("h_phiy", "H_m: bearing by y [rad/m]"),
            Column::new("s_rr", "S, range [m²]"),
            Column::new("s_rphi", "S, off-diagonal [m rad]"),
            Column::new("s_phiphi", "S, bearing [rad²]"),
            Column::new("s_inverse_rr", "inverse of S, range [1/m²]"),
            Column::new("s_inverse_rphi", "inverse of S, off-diagonal [1/(m rad)]"),
            Column::new("s_inverse_phiphi", "inverse of S, bearing [1/rad²]"),
            Column::new("s_determinant", "determinant of S [m² rad²]"),
            Column::new("mahalanobis_squared", "squared Mahalanobis distance of the innovation"),
            Column::new("log_weight", "log-weight [nats]"),
            Column::new("weight", "weight [1/(m rad)]"),
            Column::new("k_xr", "gain: x by range"),
            Column::new("k_xphi", "gain: x by bearing [m/rad]"),
            Column::new("k_yr", "gain: y by range"),
            Column::new("k_yphi", "gain: y by bearing [m/rad]"),
            Column::new("after_x_m", "landmark after, x [m]"),
            Column::new("after_y_m", "landmark after, y [m]"),
            Column::new("after_xx_m2", "its covariance, xx [m²]"),
            Column::new("after_xy_m2", "its covariance, xy [m²]"),
            Column::new("after_yy_m2", "its covariance, yy [m²]"),
            Column::new("normalized_weight", "weight as a share of both"),
            Column::new("ess", "effective number of particles"),
            Column::new("ess_limit", "threshold times the number of particles"),
            Column::new("resampled", "1 where the particles are to be resampled"),
        ];
        let WorkedExample { before, noise: q, updates, weights, ess, limit, resamples } = &self.example;
        let resampled = f64::from(u8::from(*resamples));
        let row = |(slot, update): (usize, &Update)| {
            let Update { world_from_robot: pose, z, innovation, weight, gain: k, after, .. } = update;
            let (h, s, i) = (&innovation.prediction.h_m, &innovation.covariance, &innovation.inverse);
            let (expected, nu) = (&innovation.prediction.z, &innovation.residual);
            let (b, a) = (&before.covariance, &after.covariance);
            [
                [slot as f64 + 1.0, pose.x, pose.y, pose.theta].as_slice(),
                &[z.x, z.y, before.mean.x, before.mean.y, b.m11, b.m12, b.m22, q.m11, q.m22],
                &[expected.x, expected.y, nu.x, nu.y, h.m11, h.m12, h.m21, h.m22],
                &[s.m11, s.m12, s.m22, i.m11, i.m12, i.m22, innovation.determinant()],
                &[innovation.mahalanobis_squared, innovation.log_likelihood(), *weight],
                &[k.m11, k.m12, k.m21, k.m22, after.mean.x, after.mean.y, a.m11, a.m12, a.m22],
                &[weights.as_slice()[slot], *ess, *limit, resampled],
            ]
            .concat()
        };
        Series { columns: COLUMNS.into(), rows: updates.iter().enumerate().map(row).collect() }
    }

    fn describe(&self) -> String {
        let of = |slot: usize| {
            let Update { innovation, weight, .. } = &self.example.updates[slot];
            let nu = innovation.residual;
            [*weight, innovation.mahalanobis_squared, nu.x, nu.y].map(|x| plain(x, 4))
        };
        let ([w1, d1, r1, phi1], [w2, d2, r2, phi2]) = (of(0), of(1));
        let verdict = self.verdict();
        worked_example::Shown {
            verdict: &verdict,
            w1: &w1,
            w2: &w2,
            d1: &d1,
            d2: &d2,
            r1: &r1,
            phi1: &phi1,
            r2: &r2,
            phi2: &phi2,
        }
        .say()
    }

    fn narrate(&self) -> String {
        let shown = steps::steps(self.recipe.all_steps);
        if let Some(rank) = steps::pointed(self.recipe.row, shown) {
            return shown[rank].told(shown);
        }
        let [w1, w2] = [0, 1].map(|slot| plain(self.example.updates[slot].weight, 4));
        worked_example::NTold { w1: &w1, w2: &w2, verdict: &self.verdict() }.say()
    }

    /// Of both particles.
    fn trace(&self) -> Vec<TraceLine> {
        let WorkedExample { updates, weights, ess, resamples, .. } = &self.example;
        let both = |key, of: &dyn Fn(usize) -> String| TraceLine::new(key, format!("{} / {}", of(0), of(1)));
        let pair = |x: f64, y: f64| format!("({}, {})", plain(x, 3), plain(y, 3));
        vec![
            both("propose", &|slot| {
                let Pose2 { x, y, theta } = updates[slot].world_from_robot;
                pose_text([x, y, theta])
            }),
            both("innovate", &|slot| {
                let innovation = &updates[slot].innovation;
                let d2 = plain(innovation.mahalanobis_squared, 3);
                format!("ν = {}, d² = {d2}", pair(innovation.residual.x, innovation.residual.y))
            }),
            both("weigh", &|slot| plain(updates[slot].weight, 4)),
            both("update", &|slot| format!("μ = {}", pair(updates[slot].after.mean.x, updates[slot].after.mean.y))),
            TraceLine::new("extend", ""),
            both("normalise", &|slot| plain(weights.as_slice()[slot], 3)),
            TraceLine::new("ess", ess_text(*ess, updates.len())),
            TraceLine::new("resample", if *resamples { common::yes() } else { common::no() }),
        ]
    }
}

impl WorkedExampleModel {
    /// N_eff against the threshold, and what follows: "1.57 > 1: do not resample".
    pub fn verdict(&self) -> String {
        let WorkedExample { ess, limit, resamples, .. } = self.example;
        // With as many decimals as tell the two apart, up to six.
        let differ = |decimals: &i32| fixed(ess, *decimals) != fixed(limit, *decimals);
        let decimals = (2..=6).find(differ);
        let (sign, what) = match decimals {
            _ if resamples => ("<", worked_example::resample()),
            Some(_) => (">", worked_example::do_not_resample()),
            None => ("≥", worked_example::do_not_resample()),
        };
        let decimals = decimals.unwrap_or(2);
        let limit = fixed(limit, decimals);
        format!("{} {sign} {}: {what}", fixed(ess, decimals), limit.trim_end_matches('0').trim_end_matches('.'))
    }
}
