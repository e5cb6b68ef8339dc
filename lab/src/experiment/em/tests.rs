use super::*;

fn log(seed: u64) -> Log {
    Log::new(&LogSetup { seed, ..LogSetup::default() }).unwrap()
}

fn ended(log: &Log, guess: &Guess) -> (End, DoorMap) {
    let last = climb(log, guess.first_map().unwrap(), ITERATIONS).unwrap().pop().unwrap();
    (end(log, last.clone()).unwrap(), last.map)
}

const FOLDING: Guess = Guess { marks: [2.6, 5.2, 5.2], trust: 1.0 };

#[test]
fn scratch() {
    for seed in 0..30 {
        let log = log(seed);
        let (right, map) = ended(&log, &Guess::default());
        let (fold, folded) = ended(&log, &FOLDING);
        let (blank, _) = ended(&log, &Guess { trust: 0.0, ..FOLDING });
        let mut others = Others::default();
        while others.pending() > 0 { others.advance(&log).unwrap(); }
        let best = others.ends().iter().map(|e| e.log_posterior).fold(f64::MIN, f64::max);
        let n = others.ends().iter().filter(|e| e.again > 0.5).count();
        let mut cloud = Cloud::new(&log).unwrap();
        let t = std::time::Instant::now();
        while cloud.pending(&log) > 0 { cloud.advance(&log); }
        println!("{seed} right {:.1} {:.2} {:.1?} fold {:.1} {:.2} {:.1?} blank {:.1} {:.2} others best {best:.1} {n} again; particles again {:.2} {:?}", right.log_posterior, right.again, doors(&map), fold.log_posterior, fold.again, doors(&folded), blank.log_posterior, blank.again, again(cloud.shares(log.carried).unwrap()), t.elapsed());
    }
}
