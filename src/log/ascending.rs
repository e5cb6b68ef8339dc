//! Readings in ascending order: a log has millions of them.

/// Numbers in the order of [`f32::total_cmp`], by the bytes of their bits from the last to the first (radix sort; Knuth, *TAOCP* 3, §5.2.5): no two
/// of them are compared, and the time grows as their count does.
pub(crate) fn ascending(numbers: Vec<f32>) -> Vec<f32> {
    let mut to = vec![0.0; numbers.len()];
    let mut from = numbers;
    for byte in 0..4 {
        let digit = |x: f32| usize::from(key(x).to_le_bytes()[byte]);
        let mut places = [0; 256];
        from.iter().for_each(|x| places[digit(*x)] += 1);
        let mut before = 0;
        for place in &mut places {
            before += core::mem::replace(place, before);
        }
        for x in &from {
            let place = &mut places[digit(*x)];
            to[*place] = *x;
            *place += 1;
        }
        core::mem::swap(&mut from, &mut to);
    }
    from
}

/// A number's bits, so that they are in the order of the numbers: all are turned round where it is negative, and the first one where it is not.
fn key(x: f32) -> u32 {
    let bits = x.to_bits();
    bits ^ if x.is_sign_negative() { u32::MAX } else { 1 << 31 }
}

#[cfg(test)]
mod tests {
    use super::ascending;

    #[test]
    fn any_numbers_are_in_the_order_in_which_std_sorts_them() {
        let mut bits = 7_u32;
        let mut next = || {
            bits = bits.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            f32::from_bits(bits)
        };
        let ends =
            [0.0, -0.0, f32::INFINITY, f32::NEG_INFINITY, f32::NAN, -f32::NAN, f32::MIN_POSITIVE, 2.5, 2.5, -2.5];
        let numbers: Vec<f32> = (0..5000).map(|_| next()).chain(ends).collect();
        let mut expected = numbers.clone();
        expected.sort_by(f32::total_cmp);
        let bits = |numbers: &[f32]| numbers.iter().map(|x| x.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&ascending(numbers)), bits(&expected));
        assert!(ascending(Vec::new()).is_empty());
    }
}
