//! stub for tuning
use fastslam::experiment::table::*;
use fastslam::experiment::lap::*;
use fastslam::matching::Matcher;
use fastslam::proposal::ProposalKind;
use rayon::prelude::*;
fn main() {
    let seeds: u64 = std::env::args().nth(1).map_or(40, |s| s.parse().unwrap());
    let ms: Vec<usize> = std::env::args().nth(2).map_or(PARTICLES.to_vec(), |s| s.split(',').map(|x| x.parse().unwrap()).collect());
    let mm = std::env::args().nth(3).unwrap_or("both".into());
    let pp = std::env::args().nth(4).unwrap_or("both".into());
    let mut setups = vec![];
    for proposal in [ProposalKind::Aware, ProposalKind::Motion] { if pp != "both" && pp != proposal.to_string() { continue; }
    for matcher in [Matcher::Cell, Matcher::SubCell] { if mm != "both" && mm != matcher.to_string() { continue; }
    for &particles in &ms { for seed in 0..seeds { setups.push(LapSetup { particles, seed, proposal, matcher, ..LapSetup::default() }); } } } }
    let results: Vec<LapResult> = setups.par_iter().map(|s| LapResult::of(s).unwrap()).collect();
    for r in rows(&results) {
        println!("{:7} {:8} M={:3}  med {:.3} p90 {:.3} worst {:.3} aligned {:.3} odo {:.2} resampled {:.2} lineage1 {:?} ess {:.1}", r.proposal.to_string(), r.matcher.to_string(), r.particles, r.rms_median, r.rms_p90, r.rms_worst, r.rms_aligned_median, r.odometry_rms_median, r.resampled_fraction, r.lineage_one_step_median, r.final_ess_median);
    }
    let mut bad: Vec<_> = results.iter().filter(|r| r.rms_best > 0.5 && r.proposal == ProposalKind::Aware && r.particles >= 8).collect();
    bad.sort_by(|a, b| b.rms_best.total_cmp(&a.rms_best));
    for r in bad.iter().take(12) { println!("bad {:?}", r); }
}
