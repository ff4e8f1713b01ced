#include "sweep.hpp"

#include <cmath>
#include <utility>

namespace gnomon::evaluation {

std::vector<double> sweep_axis::values() const
{
    std::vector<double> result;
    for (int i = 0; i < count; ++i) {
        const double t = count > 1 ? double(i) / (count - 1) : 0;
        result.push_back(scale == evaluation::scale::log ? least * std::pow(most / least, t)
                                                         : least + (most - least) * t);
    }
    return result;
}

std::vector<sweep_layer> layers_of_methods(
    const std::function<double(const filterable_method&, double x, double y)>& error)
{
    std::vector<sweep_layer> result;
    for (const method* m : methods_in_order())
        if (const auto* filterable = dynamic_cast<const filterable_method*>(m))
            result.push_back(
                {m->id, m->label, [error, filterable](double x, double y) { return error(*filterable, x, y); }});
    return result;
}

std::vector<std::vector<double>> errors_of(const sweep& s, const sweep_layer& l)
{
    std::vector<std::vector<double>> result;
    for (const double y : s.y.values()) {
        std::vector<double>& row = result.emplace_back();
        for (const double x : s.x.values()) row.push_back(l.error(x, y));
    }
    return result;
}

} // namespace gnomon::evaluation
