//! Voronoi curves, skeletons, mazes and crack textures: the pure core.
//!
//! Knows no Python, no files, no clock and no global random state. See `rust/ARCHITECTURE.md`.

mod bits;
pub mod clip;
pub mod crack;
mod crew;
pub mod deflate;
pub mod diagram;
pub mod error;
pub mod graph;
mod huffman;
pub mod incidence;
pub mod levels;
pub mod maze;
pub mod measure;
mod parallel;
pub mod png;
pub mod predicates;
pub mod quad_edge;
pub mod quantile;
pub mod raster;
pub mod region;
pub mod rng;
pub mod sample;
mod scatter;
pub mod sets;
pub mod skeleton;
pub mod texture;
pub mod tiff;
pub mod watch;

pub use diagram::{Diagram, DiagramView};
pub use error::{Error, Result};
pub use graph::{PlanarGraph, Point};
pub use parallel::{in_one_pool, in_pool_of};
pub use watch::Watch;
