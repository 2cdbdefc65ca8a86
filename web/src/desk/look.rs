//! What the page sees of the rows: those in sight, one that is explained or found, the trace, and
//! a report.

use super::{Desk, rows};
use crate::message::{Explained, FromDesk, RowView, Selection, TraceView};
use encoderscope::{
    dump::Dump,
    sheet::{Filter, Order, Quantity, Sheet, Show},
};

/// Rows at the front of a report, and faulty ones behind them.
const REPORTED: usize = 4;

impl Desk {
    pub(super) fn show(&self, shown: &Selection) {
        let show = Show::ALL.into_iter().find(|show| show.name() == shown.show);
        let range = shown.range.as_ref().and_then(|(name, low, high)| {
            Quantity::parse(name).map(|quantity| (quantity, *low, *high))
        });
        let filter = Filter {
            show: show.unwrap_or_default(),
            status: shown.status,
            range,
        };
        let order = shown.order.as_ref().and_then(|(name, descending)| {
            let by = Quantity::parse(name)?;
            let descending = *descending;
            Some(Order { by, descending })
        });
        {
            let mut state = self.state.borrow_mut();
            if state.shown == (filter, order) {
                return;
            }
            state.shown = (filter, order);
            if let Some(sheet) = &mut state.sheet {
                sheet.show(filter, order);
            }
            if !state.done {
                return;
            }
        }
        let desk = self.clone();
        let job = self.state.borrow().job;
        wasm_bindgen_futures::spawn_local(async move { desk.arrange(job).await });
    }

    /// Looks at the rows with what there is of the sheet and the dump.
    pub(super) fn look<T>(&self, with: impl FnOnce(&Sheet, &Dump) -> T) -> Option<T> {
        let state = self.state.borrow();
        Some(with(state.sheet.as_ref()?, state.paper.dump()?))
    }

    pub(super) fn send_rows(&self, first: usize, count: usize) {
        let rows = self.look(|sheet, dump| {
            let medium = sheet.decoder().profile().medium();
            let places = first..first.saturating_add(count).min(sheet.shown());
            let rows = places
                .filter_map(|place| sheet.row(dump, sheet.shown_at(place)?))
                .map(|row| rows::row_view(&row, medium));
            rows.collect::<Vec<RowView>>()
        });
        let rows = rows.unwrap_or_default();
        self.post(FromDesk::Rows { first, rows });
    }

    fn explained(&self, index: usize) -> Option<Explained> {
        self.look(|sheet, dump| {
            let medium = sheet.decoder().profile().medium();
            let row = sheet.row(dump, index)?;
            Some(rows::explained(&row, medium))
        })
        .flatten()
    }

    pub(super) fn explain(&self, index: usize) {
        let explained = self.explained(index);
        let mut state = self.state.borrow_mut();
        state.awaited = (explained.is_none() && !state.done).then_some(index);
        if let Some(mut explained) = explained {
            state.explained = Some(index);
            explained.says.extend(state.captured.said_of(index));
            drop(state);
            self.post(FromDesk::Explained(Box::new(explained)));
        }
    }

    pub(super) fn find(&self, wanted: impl FnOnce(&Sheet, &Dump) -> Option<usize>) {
        let found = self.look(|sheet, dump| {
            let index = wanted(sheet, dump)?;
            (index < sheet.len()).then_some(())?;
            Some((sheet.place_of(index)?, index))
        });
        self.post(FromDesk::Found(found.flatten()));
    }

    pub(super) fn trace(&self, from: usize, to: usize, columns: usize) {
        let traced = self.look(|sheet, dump| {
            let mut view = TraceView {
                from,
                to: to.min(sheet.len()),
                ..TraceView::default()
            };
            for column in sheet.columns(dump, from, to, columns) {
                let (low, high) = column.range.unwrap_or((f64::NAN, f64::NAN));
                let gap = column.gaps > 0 && column.range.is_none();
                view.rows.push(column.row as f64);
                view.degrees.push(low);
                if !gap && low < high {
                    view.rows.push(column.row as f64);
                    view.degrees.push(high);
                }
            }
            view
        });
        self.post(FromDesk::Trace(traced.unwrap_or_default()));
    }

    /// The first rows, and the first ones of each fault.
    pub(super) fn report(&self) {
        let indices = self.look(|sheet, _| {
            let figures = sheet.figures();
            let faulty = figures.faults.iter().chain(&figures.skips);
            let mut all: Vec<usize> = (0..sheet.len().min(REPORTED)).collect();
            all.extend(faulty.map(|tally| tally.first).take(REPORTED));
            all.sort_unstable();
            all.dedup();
            all
        });
        let rows = indices.unwrap_or_default().into_iter();
        let rows = rows.filter_map(|index| self.explained(index)).collect();
        self.post(FromDesk::Report(rows));
    }
}
