//! Cracks: the walls of a maze, followed as strands and given a width. One step of a recipe a file.

mod aged;
mod bow;
mod fence;
mod growth;
mod hooks;
mod impact;
mod net;
mod noise;
mod room;
mod roughen;
mod spacing;
mod split;
mod straighten;
mod strand;
mod stubs;
mod walls;
mod warp;
mod width;

pub use aged::Aged;
pub use fence::{Fence, FenceView};
pub use growth::arrivals;
pub use hooks::parted;
pub use impact::{Impact, impact, spokes};
pub use net::{Net, NetView};
pub use roughen::{Rough, Roughness, roughen};
pub use spacing::spacing;
pub use split::{Splitting, split};
pub use straighten::{Straightening, straighten};
pub use strand::{Strands, pairs, strands};
pub use stubs::{Grown, Stubs, stubs};
pub use walls::{Walls, on_torus, within};
pub use warp::warp;
pub use width::{Profile, widths};
