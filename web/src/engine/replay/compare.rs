//! What two recordings come to.

use super::{Player, Stage, TURN};
use crate::{
    browser::{now, pause},
    engine::Engine,
    message::{Answer, Digest, Link},
    plot::{PlotRequest, Quantity, Stretch},
    store,
    tally::Tally,
    transcript::Transcript,
};
use encoderscope::language::t;

/// Points of the angle over time.
const COLUMNS: u32 = 800;

impl Engine {
    /// Reads two recordings to their ends, and says what each comes to.
    pub(in crate::engine) fn compare(&self, names: [String; 2]) {
        let engine = self.clone();
        wasm_bindgen_futures::spawn_local(async move {
            let [one, other] = names;
            let made = (engine.digest(&one).await, engine.digest(&other).await);
            match made {
                (Some(one), Some(other)) => {
                    let both = Box::new([one, other]);
                    engine.hand(Answer::Comparison(both), None);
                }
                _ => engine.fault(t("One of them cannot be read.")),
            }
        });
    }

    async fn digest(&self, name: &str) -> Option<Digest> {
        let file = self.recording(name).await?;
        let mut player = Player::new(name.into(), file, String::new());
        player.set_speed(f64::INFINITY, now());
        let mut tally = Tally::new(0, Transcript::default());
        tally.transcript().replays = true;
        let (mut run, mut link) = (None, Link::Closed);
        let (mut profile, mut adapter) = (String::new(), String::new());
        while !player.is_over() {
            if let Some(piece) = player.next_piece() {
                let bytes = store::bytes(&piece).await.ok()?;
                player.push(&bytes);
            }
            let mut stage = Stage {
                run: &mut run,
                tally: &mut tally,
                link: &mut link,
            };
            player.play(&mut stage, now(), TURN);
            if player.fault().is_some() {
                return None;
            }
            if let Some(line) = player.line() {
                profile.clone_from(&line.profile);
                adapter.clone_from(&line.adapter);
            }
            pause(0.0).await;
        }
        let time = player.time();
        let request = PlotRequest {
            stretch: Stretch::All,
            columns: COLUMNS,
            quantities: vec![Quantity::Angle],
        };
        let plot = tally.trail().plot(None, &request);
        Some(Digest {
            name: name.into(),
            seconds: player.length() as f64 / 1e6,
            profile,
            adapter,
            counts: player.counts(&tally),
            last: Box::new(tally.snapshot(time)),
            angle: plot.traces.into_iter().next(),
        })
    }
}
