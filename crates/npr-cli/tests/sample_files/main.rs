//! The command on files that lie beside the checkout: sound ones and broken ones.

mod bitmaps;
mod files;
mod malformed;
mod models;
