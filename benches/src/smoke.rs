//! What cartoon smoke costs and how calm it is: [`subject`]s, a [`ledger`] of what the stages of a frame take, and how
//! many tones change without cause while smoke or camera move, in [`calm`].

pub mod calm;
pub mod subject;
