//! How comic pictures behave: [`motion`] of strokes while the camera goes round, [`price`] of ink and hatching against
//! plain tones, [`shift`] of ink against its surface, and [`gallery`], sheets of every preset for people to look at.

pub mod gallery;
pub mod motion;
pub mod price;
pub mod shift;
