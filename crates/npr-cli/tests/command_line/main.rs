//! The command `npr` as scripts see it: exit codes, messages, streams and files.

mod animate;
mod broken_bitmaps;
mod clips;
mod closing;
mod colors;
mod debug_layers;
mod determinism;
mod farm;
mod ffmpeg;
mod figures;
mod files;
mod id_maps;
mod idle;
mod info;
mod layers;
mod lines;
mod looks;
mod odd_bitmaps;
mod outline;
mod scenes;
mod smoke;
mod streams;
mod timings;
mod trace;
mod usage;
mod workplace;
