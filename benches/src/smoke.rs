//! How calm cartoon smoke is: [`subject`]s, and how many tones change without cause while smoke or camera move, in
//! [`calm`].

pub mod calm;
#[cfg(test)]
mod films;
pub mod subject;
