//! What the plot and the standstill panel ask for.

use super::State;
use crate::{message::Answer, plot::PlotRequest};

impl State {
    /// Answers with what there is to plot.
    pub(super) fn plot(&self, request: &PlotRequest) {
        let trail = self.tally.trail();
        let plot = trail.plot(self.run.is_some().then(|| self.time()), request);
        (self.hand)(Answer::Plot(Box::new(plot)), None);
    }

    /// Answers with how much the angle varies.
    pub(super) fn rest(&mut self) {
        let now = self.time();
        let rest = self.tally.trail_mut().rest(now);
        (self.hand)(Answer::Rest(rest.map(Box::new)), None);
    }
}
