// Resolved lists with fewer ranges. On a fine mesh a texel sees one triangle after the other, each for a short time,
// and all of them almost on one line of depth. Consecutive ranges become one as long as some line stays behind all of
// them by at most a tolerance (the opening of a cone, Williams 1981). All that was lit stays lit; shadow is lost only
// within that depth.
#ifndef GNOMON_PASSES_RANGE_JOIN_HPP
#define GNOMON_PASSES_RANGE_JOIN_HPP

#include "../../motion/range/range.h"
#include "../../portable/cpp_only.h"

#include <algorithm>
#include <limits>
#include <span>

GNOMON_NAMESPACE_BEGIN

namespace detail {

/// The set of lines that begin half a tolerance behind the begin of a first range and lie behind all ranges joined so
/// far, by at most the tolerance.
template <class T> class joining_cone {
  public:
    joining_cone(const depth_time_range<T>& first, T tolerance)
        : joined_(first), tolerance_((std::min)(tolerance, T(2))), depth_(first.z0 + T(0.5) * tolerance_)
    {
        narrow(first.t1, first.z1);
    }

    /// Join the next range and return true if some line remains; else return false.
    bool add(const depth_time_range<T>& next)
    {
        const joining_cone before = *this;
        narrow(next.t0, next.z0), narrow(next.t1, next.z1);
        if (!(least_ <= most_)) {
            *this = before;
            return false;
        }
        joined_.t1 = next.t1;
        joined_.id = joined_.id == next.id ? next.id : T(range_mixed);
        several_ = true;
        return true;
    }

    depth_time_range<T> joined() const
    {
        depth_time_range<T> r = joined_;
        if (!several_) return r;
        r.z0 = depth_;
        r.z1 = depth_ + (r.t1 - r.t0) * (T(0.5) * least_ + T(0.5) * most_);
        return r;
    }

  private:
    void narrow(T t, T z)
    {
        const T passed = t - joined_.t0;
        if (!(passed > 0)) return;
        least_ = (std::max)(least_, (z - depth_) / passed);
        most_ = (std::min)(most_, (z + tolerance_ - depth_) / passed);
    }

    depth_time_range<T> joined_;
    T tolerance_, depth_, least_ = std::numeric_limits<T>::lowest(), most_ = (std::numeric_limits<T>::max)();
    bool several_ = false;
};

} // namespace detail

/// Join the ranges of a resolved list, in place and in order of time, and return the list that remains. Ranges are
/// joined only if they follow one another without a gap and same(a, b) returns true, for ranges of one surface. A
/// joined range lies behind every part by 0 to the tolerance, up to 8 roundings of its depths. A joined range of
/// several ids has the id range_mixed, and shadows all of them. A tolerance that is not above 0 joins nothing; one above 2,
/// the whole range of depth, counts as 2.
/// Domain: lists without second layers (range_ids::any makes some).
template <class T, class Same>
std::span<depth_time_range<T>> join_ranges(std::span<depth_time_range<T>> list, T tolerance, const Same& same)
{
    if (!(tolerance > 0)) return list;
    std::size_t count = 0;
    for (std::size_t k = 0; k < list.size();) {
        detail::joining_cone<T> cone(list[k], tolerance);
        std::size_t next = k + 1;
        while (next < list.size() && list[next].t0 == list[next - 1].t1 && same(list[next - 1], list[next]) &&
               cone.add(list[next]))
            ++next;
        list[count++] = cone.joined();
        k = next;
    }
    return list.first(count);
}

GNOMON_NAMESPACE_END
#endif
