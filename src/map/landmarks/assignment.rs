//! Which feature gets which landmark where several want the same one: the assignment problem.
//!
//! The Hungarian method with potentials, one shortest augmenting path for each feature (Kuhn 1955; Jonker and Volgenant 1987). It is written
//! here because `pathfinding`, the crate that would fit, needs `num-traits` with its default features, which switch `nalgebra` from `libm` to
//! the functions of the platform, so that results would differ from one to the next.

use crate::order::sorted;

/// A landmark that a feature may be of.
#[derive(Clone, Copy, PartialEq, Debug)]
pub(super) struct Candidate {
    /// Index of the feature.
    pub(super) feature: usize,
    /// Index of the landmark.
    pub(super) landmark: u32,
    /// How much likelier it is than a new landmark \[nats\], above 0.
    pub(super) gain: f64,
    /// ln N(ν; 0, S) \[nats\].
    pub(super) log_likelihood: f64,
}

/// The candidates of the largest total gain among all choices in which no two are of one feature or of one landmark, in the order given.
/// Candidates of one feature stand together.
pub(super) fn assign(candidates: &[Candidate]) -> Vec<Candidate> {
    let best = candidates.chunk_by(|a, b| a.feature == b.feature).map(|of_one| *largest(of_one));
    let mut greedy: Vec<Candidate> = best.collect();
    let contested: Vec<u32> = greedy.iter().map(|c| c.landmark).filter(|j| wanted(&greedy, *j) > 1).collect();
    if contested.is_empty() {
        return greedy; // each has what it likes best: nothing is better
    }
    let (part, features) = connected(candidates, contested);
    let solved = solve(&part);
    greedy.retain(|candidate| !features.contains(&candidate.feature));
    candidates.iter().filter(|one| greedy.contains(one) || solved.contains(one)).copied().collect()
}

/// The candidate of the largest gain, the first of equals.
fn largest(candidates: &[Candidate]) -> &Candidate {
    candidates.iter().fold(&candidates[0], |best, other| if other.gain > best.gain { other } else { best })
}

/// How many of these candidates are of this landmark.
pub(super) fn wanted(candidates: &[Candidate], landmark: u32) -> usize {
    candidates.iter().filter(|candidate| candidate.landmark == landmark).count()
}

/// The candidates that a contest for these landmarks can reach, over features that could take either, and their features.
fn connected(candidates: &[Candidate], mut landmarks: Vec<u32>) -> (Vec<Candidate>, Vec<usize>) {
    let mut features: Vec<usize> = Vec::new();
    loop {
        let reached = |c: &&Candidate| landmarks.contains(&c.landmark) && !features.contains(&c.feature);
        let Some(feature) = candidates.iter().find(reached).map(|candidate| candidate.feature) else { break };
        features.push(feature);
        landmarks.extend(candidates.iter().filter(|c| c.feature == feature).map(|c| c.landmark));
    }
    (candidates.iter().filter(|candidate| features.contains(&candidate.feature)).copied().collect(), features)
}

/// The same as [`assign`] for candidates that hang together.
fn solve(candidates: &[Candidate]) -> Vec<Candidate> {
    let mut features: Vec<usize> = candidates.iter().map(|candidate| candidate.feature).collect();
    let landmarks = candidates.iter().map(|candidate| candidate.landmark).collect();
    let mut landmarks: Vec<u32> = sorted(landmarks, Ord::cmp);
    features.dedup();
    landmarks.dedup();
    // Rows are features. A column of zeros is as good as a new landmark, and so is an entry of 0.
    let columns = landmarks.len().max(features.len());
    let mut costs = vec![vec![0.0; columns]; features.len()];
    for (row, costs) in costs.iter_mut().enumerate() {
        for candidate in candidates.iter().filter(|candidate| candidate.feature == features[row]) {
            costs[landmarks.partition_point(|j| *j < candidate.landmark)] = -candidate.gain;
        }
    }
    let rows = cheapest(&costs, columns);
    let is_chosen = |candidate: &&Candidate| {
        rows.get(landmarks.partition_point(|j| *j < candidate.landmark)).copied().flatten()
            == features.iter().position(|feature| *feature == candidate.feature)
    };
    candidates.iter().filter(is_chosen).copied().collect()
}

/// The row that each column is given to, so that the costs of the pairs add up to the least: every row has a column, of which there are
/// as many or more.
fn cheapest(costs: &[Vec<f64>], columns: usize) -> Vec<Option<usize>> {
    let (mut row_of, mut column_potentials) = (vec![None; columns], vec![0.0; columns]);
    let mut row_potentials = vec![0.0; costs.len()];
    for first in 0..costs.len() {
        // Dijkstra from this row over reduced costs to a column that is free.
        let (mut distances, mut before) = (vec![f64::INFINITY; columns], vec![None; columns]);
        let mut visited: Vec<usize> = Vec::new();
        let (mut row, mut column, mut travelled) = (first, None, 0.0);
        loop {
            for next in (0..columns).filter(|next| !visited.contains(next)) {
                let distance = travelled + costs[row][next] - row_potentials[row] - column_potentials[next];
                if distance < distances[next] {
                    (distances[next], before[next]) = (distance, column);
                }
            }
            let open = (0..columns).filter(|next| !visited.contains(next));
            let nearest = open.reduce(|best, next| if distances[next] < distances[best] { next } else { best });
            let Some(reached) = nearest else { break };
            (column, travelled) = (Some(reached), distances[reached]);
            let Some(taken_by) = row_of[reached] else { break };
            visited.push(reached);
            row = taken_by;
        }
        row_potentials[first] += travelled;
        for visited in visited {
            let slack = travelled - distances[visited];
            column_potentials[visited] -= slack;
            if let Some(row) = row_of[visited] {
                row_potentials[row] += slack;
            }
        }
        // Along the path each column passes to the row before it.
        while let Some(at) = column {
            column = before[at];
            row_of[at] = column.map_or(Some(first), |before: usize| row_of[before]);
        }
    }
    row_of
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::random::{Purpose, Stream};

    fn total(candidates: &[Candidate]) -> f64 {
        candidates.iter().map(|candidate| candidate.gain).sum()
    }

    /// The largest total gain by trying everything.
    fn brute(candidates: &[Candidate], taken: &mut Vec<u32>) -> f64 {
        let Some(first) = candidates.first() else { return 0.0 };
        let (of_first, others) = candidates.split_at(candidates.partition_point(|c| c.feature == first.feature));
        let mut best = brute(others, taken);
        for candidate in of_first {
            if !taken.contains(&candidate.landmark) {
                taken.push(candidate.landmark);
                best = best.max(candidate.gain + brute(others, taken));
                taken.pop();
            }
        }
        best
    }

    /// 2000 problems of up to six features and seven landmarks, from nearly empty to full, half of them with many equal gains.
    #[test]
    fn the_gain_is_that_of_trying_everything() {
        let mut contests = 0;
        for trial in 0..2000 {
            let mut stream = Stream::at(1, Purpose::TRIAL, trial, 0);
            let [rows, columns] = [6.0, 7.0].map(|most: f64| (1.0 + most * stream.uniform()).floor() as usize);
            let share = stream.uniform();
            let mut candidates = Vec::new();
            for feature in 0..rows {
                for landmark in 0..columns as u32 {
                    let [there, gain] = [stream.uniform(), 9.0 * stream.uniform()];
                    if there < share {
                        let gain = if trial % 2 == 0 { gain.ceil() } else { gain };
                        candidates.push(Candidate {
                            feature,
                            landmark: 10 * landmark,
                            gain,
                            log_likelihood: gain - 7.0,
                        });
                    }
                }
            }
            let chosen = assign(&candidates);
            let expected = brute(&candidates, &mut Vec::new());
            assert!((total(&chosen) - expected).abs() < 1e-12, "{candidates:?}: {chosen:?}, {expected}");
            for (k, one) in chosen.iter().enumerate() {
                assert!(candidates.contains(one));
                assert!(chosen[..k].iter().all(|c| c.feature < one.feature && c.landmark != one.landmark));
            }
            let greedy: f64 =
                candidates.chunk_by(|a, b| a.feature == b.feature).map(|of_one| largest(of_one).gain).sum();
            contests += usize::from(greedy > expected + 1e-9);
        }
        assert!(contests > 500, "{contests} of them are not solved by each taking its best");
    }

    #[test]
    fn a_feature_gives_way_where_the_other_loses_more() {
        let candidate = |feature, landmark, gain| Candidate { feature, landmark, gain, log_likelihood: gain };
        let candidates = [candidate(0, 4, 3.0), candidate(0, 7, 2.5), candidate(1, 4, 2.0), candidate(2, 9, 1.0)];
        assert_eq!(assign(&candidates), [candidates[1], candidates[2], candidates[3]]);
        assert_eq!(assign(&candidates[..1]), candidates[..1]);
        assert_eq!(assign(&[]), []);
    }
}
