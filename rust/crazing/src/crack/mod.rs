//! Cracks: the walls of a maze, followed as strands and given a width. One step of a recipe a file.

mod fence;
mod net;
mod straighten;
mod strand;
mod walls;
mod width;

pub use fence::{Fence, FenceView};
pub use net::{Net, NetView};
pub use straighten::{Straightening, straighten};
pub use strand::{Strands, pairs, strands};
pub use walls::{Walls, on_torus, within};
pub use width::{Profile, widths};
