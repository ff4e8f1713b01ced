#include "evaluation/core/scene.hpp"

namespace gnomon::evaluation {

namespace {

const registered<still_scene> entry{
    scene_facts{
        .id = "contact",
        .label = "duckboards on the ground at noon",
        .order = 20,
        .text =
            "Duckboards on the ground at noon. Next to a slat a filter region holds two close surfaces, and the lit "
            "one is "
            "the farther one. Storage rounds moments, and a method that trusts the rounded moments too much darkens "
            "the "
            "ground there. Raised pivots, an earlier default of moment shadow maps, show specks; the certified bound "
            "that took their place shows none. The insets differ in the signed depth between slat and ground."},
    renderer::contact_stage};

} // namespace

} // namespace gnomon::evaluation
