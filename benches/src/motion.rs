//! How still strokes lie while a camera or a figure moves.
//!
//! [`film`] says what moves: five sequences of views. [`traced`] samples the strokes of a frame a pixel apart, [`step`]
//! carries a place to the next frame by the surface that it lies on, [`tally`] compares what was carried with what is
//! drawn there: how far ends drift, how far the texture coordinate slides, what goes and comes back, how lines shiver.
//! [`causes`] tells why, by the lines of the same frames before they are joined, smoothed and left out.
//!
//! What hatching and brushes add to that is counted on pixels: [`inked`] draws a frame's ink and what the ink is to
//! show, and [`ink`] compares it with the next frame's where the surface carries it.
//!
//! Nothing here knows how strokes are made: they are read as any program would export them.

mod cause;
pub mod causes;
mod count;
pub mod film;
pub mod ink;
pub mod inked;
pub mod near;
pub mod skin;
pub mod step;
pub mod tally;
pub mod traced;

#[cfg(test)]
pub(crate) mod testing;
