//! Files of every format: sound, odd, damaged, and those beside the checkout.

mod clips;
mod figures;
mod gltf;
mod lines;
mod malformed;
mod models;
mod mutants;
mod poses;
mod puppets;
mod text_formats;
mod tolerated;
mod toons;
