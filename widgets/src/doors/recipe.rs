//! What a reader can set about the doors and the two filters.

use crate::{
    decimal, field,
    policy::{self, Chosen},
    recipe::{self, Menu, Param},
    words::{common, doors},
};
use fastslam::{map::landmarks::Gate, ops, resampling::ResamplePolicy};
use fastslam_lab::experiment::{
    ProposalKind,
    doors::{DOORS, DoorsSetup, RIDE_RANGE},
};

/// Beyond the last step of every drive: a figure that is there shows the end, wherever that is.
pub const END: u32 = 99;

/// Where a door can be \[m\], and what it is moved by.
pub const DOOR: (f64, f64, f64) = (1.0, 19.0, 0.25);

/// Names of the places of the doors.
pub const NAMES: [&str; DOORS as usize + 1] = ["door-1", "door-2", "door-3", "door-4", "door-5", "door-6", "door-7"];

/// Everything that a link can say.
#[derive(Clone, PartialEq)]
pub struct Recipe {
    /// What decides the numbers, but for gate and doors.
    asked: DoorsSetup,
    /// Where N_eff calls for resampling, while it does.
    threshold: f64,
    /// The gate, as the share of right sightings that it lets pass \[%\].
    gate: f64,
    /// The price of a new landmark is p₀ = 10 to the power of minus this.
    price: u32,
    /// Where the doors are \[m\].
    doors: [f64; DOORS as usize],
    /// Where a seventh is \[m\], if there is one.
    seventh: Option<f64>,
    /// The step asked for.
    pub step: u32,
}

impl Default for Recipe {
    /// With this seed the EKF decides for the wrong door, and four explanations live until the sign comes in sight. How often that is so
    /// is for the count over many seeds to say.
    fn default() -> Self {
        let asked = DoorsSetup { seed: 13, particles: 400, ..DoorsSetup::default() };
        let doors = core::array::from_fn(|door| asked.doors[door]);
        Self { asked, threshold: 0.5, gate: 99.0, price: 3, doors, seventh: None, step: END }
    }
}

impl Recipe {
    /// What decides the numbers.
    pub fn setup(&self) -> DoorsSetup {
        let gate = Gate {
            // The quantile of χ² with two degrees of freedom.
            mahalanobis_squared: -2.0 * ops::ln((100.0 - self.gate) / 100.0),
            log_new: ops::ln(decimal::parse(&format!("1e-{}", self.price)).unwrap_or(1e-3)),
            ..Gate::default()
        };
        DoorsSetup { gate, doors: self.doors.into_iter().chain(self.seventh).collect(), ..self.asked.clone() }
    }

    /// Moves a door \[m\], by its rank, or as near to that as it can be.
    pub fn put_door(&mut self, rank: usize, place: f64) {
        let place = place.clamp(DOOR.0, DOOR.1);
        match self.doors.get_mut(rank) {
            Some(door) => *door = place,
            None => self.seventh = Some(place),
        }
    }

    /// Says where the ride truly ends \[m\], or as near to that as it can.
    pub fn put_end(&mut self, place: f64) {
        self.asked.end = Some(place.clamp(RIDE_RANGE.start, RIDE_RANGE.end));
    }
}

impl Chosen for Recipe {
    fn chosen(&self) -> (ResamplePolicy, f64) {
        (self.asked.policy, self.threshold)
    }

    fn choose(&mut self, policy: ResamplePolicy, threshold: f64) {
        (self.asked.policy, self.threshold) = (policy, threshold);
    }
}

impl recipe::Recipe for Recipe {
    fn table() -> Vec<Param<Self>> {
        type P = Param<Recipe>;
        let versions = [(ProposalKind::Motion, doors::version_1()), (ProposalKind::Improved, doors::version_2())];
        let versions = Menu::new(versions.map(|(kind, title)| (kind, title, kind)));
        let place = |name, title, field| P::number(name, title, "m", DOOR, field, doors::door_help());
        let [policy, threshold] = policy::rows();
        vec![
            P::number("ride", doors::ride(), "m", (0.5, 8.0, 0.25), field!(asked.ride_std), doors::ride_help())
                .in_sight(),
            P::integer(
                "particles",
                doors::particles(),
                "",
                (1, 1000),
                field!(asked.particles),
                doors::particles_help(),
            )
            .in_sight(),
            P::seed(field!(asked.seed), doors::seed_help()),
            P::choice("proposal", doors::proposal(), versions, field!(asked.proposal), doors::proposal_help()),
            P::integer("price", doors::price(), "", (0, 12), field!(price), doors::price_help()),
            P::number(
                "range",
                common::range_noise(),
                "m",
                (0.02, 0.5, 0.01),
                field!(asked.sensor_std),
                doors::range_help(),
            )
            .folded(),
            P::number("gate", doors::gate(), "%", (50.0, 99.99, 0.5), field!(gate), doors::gate_help()).folded(),
            policy.folded(),
            threshold.folded(),
            P::number_or(
                "end",
                doors::end(),
                "m",
                (RIDE_RANGE.start, RIDE_RANGE.end, 0.25),
                ("drawn", doors::drawn()),
                field!(asked.end),
                doors::end_help(),
            )
            .folded()
            .without_slider(),
            place(NAMES[0], doors::door_1(), field!(doors[0])).folded().without_slider(),
            place(NAMES[1], doors::door_2(), field!(doors[1])).folded().without_slider(),
            place(NAMES[2], doors::door_3(), field!(doors[2])).folded().without_slider(),
            place(NAMES[3], doors::door_4(), field!(doors[3])).folded().without_slider(),
            place(NAMES[4], doors::door_5(), field!(doors[4])).folded().without_slider(),
            place(NAMES[5], doors::door_6(), field!(doors[5])).folded().without_slider(),
            P::number_or(
                NAMES[6],
                doors::door_7(),
                "m",
                DOOR,
                ("none", doors::none()),
                field!(seventh),
                doors::door_help(),
            )
            .folded()
            .without_slider(),
            P::integer("step", common::step(), "", (0, END), field!(step), common::step_help()).view(),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn untouched_it_is_the_experiment_with_more_particles() {
        let setup = Recipe::default().setup();
        assert_eq!(setup, DoorsSetup { seed: 13, particles: 400, ..DoorsSetup::default() });
    }

    #[test]
    fn no_drive_goes_on_beyond_the_last_step() {
        for seed in 0..40 {
            let setup = DoorsSetup { seed, end: Some(RIDE_RANGE.start), ..DoorsSetup::default() };
            assert!(setup.step_count() <= END, "seed {seed}: {}", setup.step_count());
        }
    }
}
