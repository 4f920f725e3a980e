//! How well outlines mind the background: [`frames`] are characters on painted backgrounds, [`judge`] says what every
//! place of an outline looks like beside its rim and before what lies behind it.

pub mod frames;
pub mod judge;
pub mod scenery;
