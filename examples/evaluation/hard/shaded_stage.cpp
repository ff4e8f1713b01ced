#include "shaded_stage.hpp"

#include "renderer/raster/rasterizer.hpp"

namespace gnomon::evaluation {

shaded_stage::shaded_stage(const renderer::stage& its_scenery, const settings& how)
    : scenery(its_scenery),
      depths(renderer::rasterize_depth<4>(scenery.world, scenery.light, how.map_resolution, how.map_resolution)),
      seen(renderer::rasterize_surfaces(scenery.world, scenery.eye, how.width * how.supersampling,
                                        how.height * how.supersampling)),
      where(map_receivers_of(seen, scenery.light, how.map_resolution))
{}

} // namespace gnomon::evaluation
