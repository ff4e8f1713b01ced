// How long is a moving receiver in shadow while the shutter is open?
//
// In motion a texel of the shadow map has a list of depth-time ranges in place of a depth: from time t0 to t1 the light
// sees a surface there, whose depth goes from z0 to z1 along a line. A moving receiver passes from texel to texel, and
// its own depth goes along a line, too. When one line is in front of the other is known in closed form: no time is
// sampled.
#include <gnomon/motion/range/range_list.h>
#include <gnomon/motion/receiver/moving_receiver.h>

#include <array>
#include <cstdio>
#include <vector>

using range = gnomon::depth_time_range<float>; // t0, t1, z0, z1 and the id of the surface
using list = gnomon::range_list<float>;        // room for eight ranges; what does not fit is merged, never lost

int main()
{
    // A row of three texels: all that ever covers each of them while the shutter is open, from time 0 to 1.
    const std::array<std::vector<range>, 3> seen{{
        {{0.00f, 0.45f, -0.30f, 0.20f, 1}, {0.10f, 0.30f, 0.50f, 0.50f, 2}},
        {{0.25f, 0.70f, -0.10f, 0.35f, 1}, {0.20f, 0.60f, 0.30f, -0.20f, 3}},
        {{0.55f, 1.00f, 0.10f, 0.80f, 1}, {0.00f, 0.90f, 0.20f, 0.60f, 3}},
    }};

    // A list keeps what may be in front. Resolved, it holds what is in front, as spans that do not overlap in time.
    std::array<list, 3> map;
    for (std::size_t x = 0; x < map.size(); ++x) {
        map[x] = gnomon::range_list_make(gnomon::range_empty(0.0f));
        for (const range& r : seen[x]) map[x] = gnomon::range_list_insert(map[x], r);
        map[x] = gnomon::range_list_resolve(map[x]);
        std::printf("texel %zu, the light sees:", x);
        for (const range& r : map[x].ranges)
            if (gnomon::range_duration(r) > 0)
                std::printf("  %.3f..%.3f surface %.0f", double(r.t0), double(r.t1), double(r.id));
        std::printf("\n");
    }

    // The receiver: from depth 0 to 0.5, from x = 0.2 to 2.9 in texels, along the middle of the row. w is 1 for a sun.
    const gnomon::receiver_path<float> path{{0, 1, 0.0f, 0.5f, 9}, 0.2f, 0.5f, 1, 2.9f, 0.5f, 1};

    // In closed form: for every texel that the path crosses, every span of its list.
    gnomon::moving_receiver state = gnomon::moving_receiver_begin(path, 0.0f, 1.0f); // the exposure
    gnomon::texel_sweep sweep = gnomon::texel_sweep_begin(path);
    for (bool more = true; more; sweep = gnomon::texel_sweep_next(sweep)) {
        state = gnomon::moving_receiver_texel(state, sweep);
        for (const range& r : map[std::size_t(sweep.column)].ranges) {
            const range hidden = gnomon::moving_receiver_occluding_part(state, r);       // in front of the receiver
            const float share0 = gnomon::shutter_box(hidden.t0, state.begin, state.end); // of the exposure's light
            const float share1 = gnomon::shutter_box(hidden.t1, state.begin, state.end);
            const float lost = gnomon::receiver_lost_light(hidden, path.depth.id, share0, share1); // 0 if its own
            state = gnomon::moving_receiver_add(state, lost);
        }
        more = sweep.t_end < sweep.t_last;
    }
    const float exact = gnomon::moving_receiver_end(state);

    // By samples in time, as stochastic shadow maps do it: at each time, is anything in front of the receiver?
    for (const int samples : {8, 64, 100000}) {
        float in_shadow = 0;
        for (int k = 0; k < samples; ++k) {
            const float t = (float(k) + 0.5f) / float(samples), depth = gnomon::range_depth(path.depth, t);
            const list& here = map[std::size_t(gnomon::receiver_path_at(path, t).x)];
            in_shadow += gnomon::range_list_intensity(here, t, depth, path.depth.id, 0.0f);
        }
        std::printf("%6d samples: in shadow for %.5f of the exposure\n", samples, double(in_shadow / float(samples)));
    }
    std::printf("   closed form: in shadow for %.5f of the exposure\n", double(exact));
}
