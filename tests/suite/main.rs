//! What the command and the library promise, seen from outside. One program, so that it links once and its
//! tests share both cores to the end.

mod bad_input;
mod check;
mod common;
mod corpus;
mod design;
mod faults;
mod found;
mod gallery;
mod library;
mod motion;
mod properties;
mod scene;
mod train;
