// Scenes for layers of moving samples, with many triangles, deformation and high depth complexity: after Andersson et
// al. 2015, Figures 1, 8, 9 and 14, and Palmer 2011, Figures 4.4 and 4.5. y points up, the ground is y = 0.
#pragma once

#include "moving_scene.hpp"

namespace gnomon::renderer {

// Andersson et al. 2015, Figures 1 and 9: eight tentacles with cups that bend, each to the other side than its
// neighbours, below and above one another. `full` has more triangles.
moving_stage tentacles(double aspect, bool full);

// The same from above, as in Figure 9.
moving_stage tentacles_from_above(double aspect, bool full);

// Andersson et al. 2015, Figure 14: a wrecking ball on a chain and a wall of boxes that fly apart.
moving_stage wrecking_ball(double aspect);

// Andersson et al. 2015, Figure 14, and Palmer 2011, Figures 4.4 and 4.5: 32 turned pieces on a board. Five of them move,
// and a king falls.
moving_stage chess(double aspect);

// Andersson et al. 2015, Figure 14: a tree with thousands of leaves, static, below a light that moves.
moving_stage tree_in_moving_light(double aspect);

// Andersson et al. 2015, Figure 14: a moving model of unit size (see import/model.hpp), which runs between two rows of
// columns.
moving_stage runner(moving_scene model, double aspect);

// A moving model of unit size, alone on a ground.
moving_stage walker(const moving_scene& model, double aspect);

// Andersson et al. 2015, Figure 8 B: plates that move one way among static boxes, before a camera that moves the other way.
moving_stage moving_eye(double aspect);

} // namespace gnomon::renderer
