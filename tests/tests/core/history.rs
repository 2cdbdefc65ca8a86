//! Laws of what is kept for plots.

#[cfg(target_arch = "wasm32")]
use wasm_bindgen_test::wasm_bindgen_test as test;

use encoderscope::history::{History, Point, Sample, Scale, Series};
use encoderscope_tests::Noise;

const SECOND: u64 = 1_000_000;

fn values(points: &[Point]) -> Vec<Option<f64>> {
    points.iter().map(|point| point.value).collect()
}

fn extremes(values: impl Iterator<Item = f64>) -> Option<(f64, f64)> {
    values.fold(None, |found, value| match found {
        None => Some((value, value)),
        Some((low, high)) => Some((value.min(low), value.max(high))),
    })
}

/// A thousand samples a second; the value of each is its number.
fn counted(samples: u64) -> Series {
    let mut series = Series::new(Scale::Line);
    for index in 0..samples {
        series.push(index * 1_000, index as f64);
    }
    series
}

#[test]
fn what_is_recent_is_kept_as_it_came() {
    let series = counted(100);
    let points = series.points(10_000, 15_000, 1_000);
    // A neighbour on either side lets the line run to the edges.
    let expected: Vec<Point> = (9..=16)
        .map(|index| Point {
            at: index * 1_000,
            value: Some(index as f64),
        })
        .collect();
    assert_eq!(points, expected);
    assert_eq!(series.span(), Some((0, 99_000)));
}

#[test]
fn a_wrap_and_a_pause_are_gaps_and_a_quick_change_is_none() {
    let mut angle = Series::new(Scale::Circle);
    for (at, value) in [
        (0, 350.0),
        (1, 359.0),
        (2, 8.0),
        (3, 170.0),
        (600_000, 171.0),
    ] {
        angle.push(at, value);
    }
    assert_eq!(
        values(&angle.points(0, SECOND, 1_000_000)),
        [
            Some(350.0),
            Some(359.0),
            None,
            Some(8.0),
            Some(170.0),
            None,
            Some(171.0)
        ]
    );
    let mut line = Series::new(Scale::Line);
    line.push(0, 350.0);
    line.push(1, 8.0);
    assert_eq!(values(&line.points(0, 10, 10)), [Some(350.0), Some(8.0)]);
}

#[test]
fn a_turn_within_a_column_draws_no_line_across() {
    let mut angle = Series::new(Scale::Circle);
    // One turn in ten seconds, to and fro.
    for index in 0..40_000u64 {
        let there = if index < 20_000 {
            index
        } else {
            40_000 - index
        };
        angle.push(index * 1_000, (there as f64 * 0.036 + 100.0) % 360.0);
    }
    let points = angle.points(0, 40 * SECOND, 300);
    for pair in points.windows(2) {
        if let (Some(one), Some(other)) = (pair[0].value, pair[1].value) {
            assert!((one - other).abs() < 30.0, "{pair:?}");
        }
    }
    let gaps = points.iter().filter(|point| point.value.is_none()).count();
    assert_eq!(gaps, 4);
}

#[test]
fn hours_are_kept_in_bounded_memory_with_their_extremes() {
    // Three hours; a single sample sticks out an hour in.
    let mut series = Series::new(Scale::Line);
    for index in 0..10_800_000u64 {
        let value = if index == 3_600_000 {
            9.0
        } else {
            (index % 2) as f64
        };
        series.push(index * 1_000, value);
    }
    assert!(series.held() <= 16_384 + 5 * 4_096);
    for (from, to) in [(0, 10_800), (3_000, 4_200), (3_599, 3_601)] {
        let points = series.points(from * SECOND, to * SECOND, 700);
        assert!(
            points.iter().any(|point| point.value == Some(9.0)),
            "{from}"
        );
        assert!(points.len() <= 4 * 703, "{from}: {}", points.len());
    }
    let recent = series.points(10_790 * SECOND, 10_800 * SECOND, 700);
    assert!(recent.len() > 1_300, "{}", recent.len());
    let last = recent.last().unwrap();
    assert!(last.at > 10_799 * SECOND, "{last:?}");
}

#[test]
fn a_line_that_drops_out_all_the_time_is_kept_for_hours_too() {
    let mut series = Series::new(Scale::Line);
    let mut now = 0;
    for _ in 0..5 * 3_600 {
        for _ in 0..40 {
            series.push(now, 1.0);
            now += 10_000;
        }
        now += 600_000;
    }
    let points = series.points(0, now, 1_000);
    assert!(points[0].at < now / 10, "{:?}", points[0]);
}

#[test]
fn a_pause_of_minutes_stays_a_gap_at_every_zoom() {
    let mut series = Series::new(Scale::Line);
    for second in (0..3_600).chain(4_200..9_000) {
        for step in 0..100 {
            series.push(second * SECOND + step * 10_000, 1.0);
        }
    }
    for from in [0, 1_800, 3_000] {
        let points = series.points(from * SECOND, 9_000 * SECOND, 800);
        let open = points
            .windows(2)
            .filter(|pair| pair.iter().all(|point| point.value.is_some()));
        for pair in open {
            assert!(pair[1].at - pair[0].at < 60 * SECOND, "{pair:?}");
        }
        assert!(points.iter().any(|point| point.value.is_none()), "{from}");
    }
}

/// Random samples: bursts, pauses, clocks that stand still or jump, and what is no number.
fn pushed(noise: &mut Noise, series: &mut Series, count: u64) -> Vec<(u64, f64)> {
    let mut now = noise.below(SECOND);
    let mut kept: Vec<(u64, f64)> = Vec::new();
    for _ in 0..count {
        now = match noise.below(200) {
            0 => now.saturating_add(noise.below(1 << 40)),
            1 => now.saturating_sub(noise.below(SECOND)),
            2 => now.saturating_add(noise.below(2 * SECOND)),
            3..40 => now,
            _ => now.saturating_add(noise.below(2_000)),
        };
        let value = match noise.below(100) {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => f64::MIN,
            3 => f64::MAX,
            _ => noise.below(360_000) as f64 / 1_000.0,
        };
        series.push(now, value);
        if value.is_finite() {
            now = now.max(kept.last().map_or(0, |(at, _)| *at));
            kept.push((now, value));
        }
    }
    kept
}

#[test]
fn whatever_is_pushed_extremes_hold_times_ascend_and_memory_is_bounded() {
    let mut noise = Noise::new(11);
    for round in 0..60 {
        let scale = if round % 2 == 0 {
            Scale::Line
        } else {
            Scale::Circle
        };
        let mut series = Series::new(scale);
        let count = noise.below(if round % 10 == 0 { 60_000 } else { 3_000 });
        let kept = pushed(&mut noise, &mut series, count);
        assert!(series.held() <= 16_384 + 5 * 4_096);
        let last = kept.last().map_or(0, |(at, _)| *at);
        for _ in 0..8 {
            let from = noise.below(last + 2);
            let to = from.saturating_add(noise.below(last - from.min(last) + 2));
            let columns = noise.below(2_000) as usize;
            let points = series.points(from, to, columns);
            assert!(points.len() <= 4 * (columns.max(1) + 3), "{columns}");
            assert!(points.windows(2).all(|pair| pair[0].at <= pair[1].at));
            let within = |at: u64| at >= from && at <= to;
            let drawn = extremes(points.iter().filter_map(|point| point.value));
            let truth = extremes(kept.iter().filter(|(at, _)| within(*at)).map(|(_, v)| *v));
            if let (Some((low, high)), Some(drawn)) = (truth, drawn) {
                assert!(drawn.0 <= low && drawn.1 >= high, "{drawn:?} {low} {high}");
            } else {
                assert_eq!(truth, None);
            }
            // What is drawn beyond lies within the buckets at the edges.
            let (Some(first), Some(end)) = (points.first(), points.last()) else {
                continue;
            };
            let near = kept.iter().filter(|(at, _)| *at >= first.at);
            let all = extremes(near.map(|(_, value)| *value));
            if let (Some(all), Some(drawn)) = (all, drawn) {
                assert!(drawn.0 >= all.0 && drawn.1 <= all.1, "{end:?}");
            }
        }
    }
}

#[test]
fn extreme_questions_are_answered() {
    let series = counted(50_000);
    for (from, to, columns) in [
        (0, 0, 0),
        (u64::MAX, u64::MAX, 1),
        (u64::MAX, 0, 100),
        (0, u64::MAX, 100),
        (0, u64::MAX, usize::MAX),
    ] {
        let points = series.points(from, to, columns);
        assert!(points.len() <= 4 * 50_000);
    }
    assert_eq!(Series::new(Scale::Line).points(0, u64::MAX, 10), []);
    let mut late = Series::new(Scale::Line);
    late.push(u64::MAX, 1.0);
    late.push(0, 2.0);
    assert_eq!(late.span(), Some((u64::MAX, u64::MAX)));
    let mut history = History::new();
    history.fail(0);
    history.fail(u64::MAX);
    history.take(u64::MAX, &Sample::default());
    history.take(0, &Sample::default());
}

#[test]
fn the_whole_of_all_levels_is_drawn_up_to_the_last_sample() {
    for samples in [1, 7, 8, 9, 63, 64, 65, 16_384, 16_385, 40_000, 300_000] {
        let series = counted(samples);
        let points = series.points(0, samples * 1_000, 300);
        let drawn = extremes(points.iter().filter_map(|point| point.value));
        assert_eq!(drawn, Some((0.0, (samples - 1) as f64)), "{samples}");
    }
}

#[test]
fn speed_is_the_encoders_own_or_follows_from_the_angle_over_zero() {
    let mut history = History::new();
    for index in 0..1_000u64 {
        let degrees = (359.0 - index as f64 * 0.9).rem_euclid(360.0);
        history.take(
            index * 1_000,
            &Sample {
                degrees,
                ..Sample::default()
            },
        );
    }
    let points = history.speed().points(0, SECOND, 1_000);
    assert!(points.len() > 900);
    for point in points {
        assert!((point.value.unwrap() + 2.5).abs() < 1e-9, "{point:?}");
    }
    let mut history = History::new();
    for index in 0..1_000u64 {
        let sample = Sample {
            degrees: 1.0,
            turns: None,
            speed: Some(3.5),
            temperature: Some(31.2),
        };
        history.take(index * 1_000, &sample);
    }
    let last = |series: &Series| series.points(0, SECOND, 10).last().and_then(|p| p.value);
    assert_eq!(last(history.speed()), Some(3.5));
    assert_eq!(last(history.temperature()), Some(31.2));
}

#[test]
fn a_speed_does_not_reach_over_a_pause_or_a_new_zero() {
    let mut history = History::new();
    let still = |degrees| Sample {
        degrees,
        ..Sample::default()
    };
    for index in 0..200u64 {
        history.take(index * 1_000, &still(10.0));
    }
    for index in 2_000..2_200u64 {
        history.take(index * 1_000, &still(100.0));
    }
    history.jump();
    for index in 2_200..2_400u64 {
        history.take(index * 1_000, &still(0.0));
    }
    let points = history.speed().points(0, 10 * SECOND, 1_000_000);
    let drawn = extremes(points.iter().filter_map(|point| point.value));
    assert_eq!(drawn, Some((0.0, 0.0)));
}

#[test]
fn counted_turns_give_a_speed_from_frames_far_apart() {
    let at_speed = |speed: f64, apart: u64, counted: bool| {
        let mut history = History::new();
        for index in 0..100u64 {
            // The counter of 16 bits begins anew on the way.
            let turned = 65_530.0 + speed * (index * apart) as f64 / 1e6;
            let turns = turned.floor() % 65_536.0;
            history.take(
                index * apart,
                &Sample {
                    degrees: turned.fract() * 360.0,
                    turns: counted.then_some(turns),
                    ..Sample::default()
                },
            );
        }
        history.turning()
    };
    for apart in [1_000, 50_000, 100_000, 1_000_000] {
        let speed = at_speed(7.3, apart, true).unwrap();
        assert!((speed - 7.3).abs() < 1e-6, "{apart}: {speed}");
    }
    assert!((at_speed(12.4, 20_000, false).unwrap() - 12.4).abs() < 1e-6);
    // Without the turns nobody knows how often it went round meanwhile.
    assert_eq!(at_speed(7.3, 1_000_000, false), None);
    assert_eq!(at_speed(50.0, 25_000, false), None);
    assert_eq!(at_speed(7.3, 3_000_000, true), None);
}

#[test]
fn errors_are_counted_over_a_second() {
    let mut history = History::new();
    for index in 0..6_000u64 {
        let at = index * 1_000;
        // Every tenth frame of the third and fourth second fails.
        if (2_000..4_000).contains(&index) && index % 10 == 0 {
            history.fail(at);
        } else {
            history.take(at, &Sample::default());
        }
    }
    let at = |time: u64| {
        let points = history.errors().points(time, time, 1);
        points.last().and_then(|point| point.value)
    };
    assert_eq!(at(1_900_000), Some(0.0));
    assert_eq!(at(3_400_000), Some(100.0));
    assert_eq!(at(5_500_000), Some(0.0));
}
