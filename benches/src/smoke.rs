//! How calm cartoon smoke is: [`subject`]s, and how many tones change without cause while smoke or camera move, in
//! [`calm`].

pub mod calm;
pub mod subject;
