// The stages of single scattering, after Peters et al. 2017, Figures 14 to 19, in metres. Each has a directional light whose
// map holds the whole scene, and a medium.
#pragma once

#include "medium.hpp"
#include "stage.hpp"

namespace gnomon::renderer {

struct scattering_stage : stage {
    medium air;
};

// Figures 15 and 19: a hall with thin walls. Shafts of light fall through its windows. An opening in the far wall shows a
// chamber that no light reaches.
scattering_stage room_stage(double aspect);

// The room with translucent veils in the shafts of light: each surface has scattering before it. Veils cast no shadow here:
// the casters are opaque_part() of the world.
scattering_stage veils_stage(double aspect);

// Figure 16: among trees, against the light.
scattering_stage trees_stage(double aspect);

// Figure 17: from the shadow of a gate of fine bars, against the light. The camera moves sideways, by 0.3 per unit of time.
scattering_stage gate_stage(double aspect, float time);

// Figure 18: light falls through a pergola. A dragon hovers in it if it is present.
scattering_stage entering_stage(double aspect, bool present);

// Figure 14: the pinnacles of a tower, with the light right behind them: all view rays near the middle run against the
// light.
scattering_stage tower_stage(double aspect);

// The same tower from the other side, with the light from behind the camera: rays along the light, in lit air.
scattering_stage antipode_stage(double aspect);

// A model of unit size (see model.hpp) on a ground plane in haze, against the light.
scattering_stage hazy_model_stage(scene model, double aspect);

} // namespace gnomon::renderer
