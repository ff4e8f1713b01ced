// Round lights and round filters from look-ups of rectangles: a disc, or an ellipse along the axes of the map, as the union
// of three rectangles that touch, in the shape of a cross. Their means, weighted by their areas, make the mean of the
// union; so moments are averaged first, and one intensity is computed.
//
// A straight edge at any angle then has a penumbra that differs from that of the disc by disc_error at most, where a single
// square of the disc's area differs by disc_square_error. Two rectangles crosswise, with twice the loads of
// the square, still differ by 0.0177, so there is no form for them.
#ifndef GNOMON_SOFT_DISC_H
#define GNOMON_SOFT_DISC_H
#include "summed_area.h"
GNOMON_NAMESPACE_BEGIN

GNOMON_CONSTANT(disc_long, 0.955);          // extents of the cross, as shares of the diameter
GNOMON_CONSTANT(disc_short, 0.5975);        //
GNOMON_CONSTANT(disc_square, 0.8862269255); // the square of the same area, sqrt(pi) / 2
GNOMON_CONSTANT(disc_error, 0.0075);
GNOMON_CONSTANT(disc_square_error, 0.0235);

/// Rectangle 0, 1 or 2 of the disc that the given rectangle bounds: the middle of the cross, and its ends towards y0 and
/// towards y1.
/// Domain: any rectangle; of its parts, those at the index as rounded to the nearest of 0, 1 and 2.
/// NaN: NaN, which summed_area_clip makes empty; index 0 for an index of NaN.
/// Error: against a disc (tests/soft/disc.cpp), of the visibility in the penumbra of a straight edge, disc_error.
GNOMON_KERNEL GNOMON_T(summed_area_rectangle) disc_rectangle(GNOMON_T(summed_area_rectangle) bounds, Real index)
{
    Real x = Real(0.5) * (bounds.x0 + bounds.x1);
    Real y = Real(0.5) * (bounds.y0 + bounds.y1);
    Real half_x = Real(0.5) * (bounds.x1 - bounds.x0);
    Real half_y = Real(0.5) * (bounds.y1 - bounds.y0);
    GNOMON_MASK first = Real(0.5) < index && index < Real(1.5);
    GNOMON_MASK second = Real(1.5) <= index;
    Real across = half_x * gnomon_select(first || second, GNOMON_LITERAL(disc_short), GNOMON_LITERAL(disc_long));
    Real inner = half_y * GNOMON_LITERAL(disc_short);
    Real outer = half_y * GNOMON_LITERAL(disc_long);
    GNOMON_T(summed_area_rectangle) r;
    r.x0 = x - across;
    r.x1 = x + across;
    r.y0 = gnomon_select(first, y - outer, gnomon_select(second, y + inner, y - inner));
    r.y1 = gnomon_select(first, y - inner, gnomon_select(second, y + outer, y + inner));
    return r;
}

GNOMON_NAMESPACE_END
#endif
