//! The binding: arrays in, arrays out, the interpreter detached while the core works.

#![allow(clippy::needless_pass_by_value, reason = "PyO3 hands arguments over by value")]

mod arrays;
mod crack;
mod diagram;
mod graph;
mod guard;
mod maze;
mod measure;
mod png;
mod region;
mod render;
mod sample;
mod skeleton;
mod texture;
mod tiff;

use pyo3::prelude::*;

#[pymodule(gil_used = false)]
mod _core {
    use pyo3::prelude::*;

    #[pymodule_export]
    use crate::crack::branches::{crack_part, crack_roughen, crack_stubs};
    #[pymodule_export]
    use crate::crack::course::crack_course;
    #[pymodule_export]
    use crate::crack::plates::crack_plates;
    #[pymodule_export]
    use crate::crack::{
        crack_arrivals, crack_impact, crack_pairs, crack_spacing, crack_split, crack_straighten, crack_walls,
        crack_walls_on_torus, crack_warp, crack_widths, crack_wrap,
    };
    #[pymodule_export]
    use crate::diagram::{
        constrained_diagram, depths, diagram, dual_edges, mosaic, onext, periodic_diagram, representatives, tile,
    };
    #[pymodule_export]
    use crate::graph::{graph_compact, graph_components, graph_degrees, graph_distances, graph_polylines};
    #[pymodule_export]
    use crate::guard::{CrazingError, DegenerateInputError, InternalError};
    #[pymodule_export]
    use crate::maze::{carve, distances, longest, solve, voronoi_doors};
    #[pymodule_export]
    use crate::measure::{stamp, statistics, thin, trace};
    #[pymodule_export]
    use crate::png::{encode_png, png_head, png_rows, png_tail};
    #[pymodule_export]
    use crate::region::{region_cells, region_contains, region_doors, region_rings, region_route};
    #[pymodule_export]
    use crate::render::render;
    #[pymodule_export]
    use crate::sample::{
        sample_from_density, sample_laplace, sample_normal, sample_poisson_disk, sample_relax, sample_uniform,
    };
    #[pymodule_export]
    use crate::skeleton::{
        axis_edges, beyond, branches, crust_mask, curve, curve_edges, edge_filter, filtered_axis, initial, links,
        longest_path, one_step, peeled, poles, poles_axis, reaching, ring_edges, sides, spans, two_pass, without_bumps,
        without_hairs,
    };
    #[pymodule_export]
    use crate::texture::{extent, levels, plates, texture};
    #[pymodule_export]
    use crate::tiff::tiff_tiles;

    /// Names the build, so that a debug build can be told from a release.
    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        module.add("__version__", env!("CARGO_PKG_VERSION"))?;
        module.add("DEBUG", cfg!(debug_assertions))
    }
}
