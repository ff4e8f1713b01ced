#include "blocks.hpp"

#include "driver.hpp"
#include "renderer/output/file.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>

namespace gnomon::evaluation {

namespace {

using json = nlohmann::ordered_json;

class page_writer {
  public:
    explicit page_writer(const std::filesystem::path& folder) : folder_(folder) {}

    json operator()(const page& what)
    {
        need(!what.title.empty() && !what.summary.empty(), "the page has no title or no summary");
        json result{{"driver", what.driver}, {"title", what.title}, {"family", what.family}, {"summary", what.summary}};
        if (const evaluation::driver* of = registry_of<evaluation::driver>().find(what.driver))
            result["order"] = of->order;
        if (what.front) {
            const json shown = picture(*what.front);
            result["front"] = {{"picture", shown["file"]}, {"alt", shown["alt"]}, {"caption", shown["caption"]}};
        }
        result["blocks"] = json::array();
        for (const block& one : what.blocks)
            result["blocks"].push_back(std::visit([&](const auto& b) { return written(b); }, one));
        return result;
    }

  private:
    void need(bool condition, const std::string& otherwise) const
    {
        if (!condition) throw std::invalid_argument(fmt::format("{}: {}", folder_.string(), otherwise));
    }

    double finite(double value, const std::string& where) const
    {
        need(std::isfinite(value), fmt::format("{} is {}", where, value));
        return value;
    }

    static json begun(const char* type, const auto& b)
    {
        json result{{"type", type}};
        if (!b.title.empty()) result["title"] = b.title;
        if (!b.text.empty()) result["text"] = b.text;
        if constexpr (requires { b.is_folded; })
            if (b.is_folded) result["folded"] = true;
        return result;
    }

    json written(const text_block& b) const
    {
        need(!b.text.empty(), "a text is empty");
        return begun("text", b);
    }

    json written(const table_block& b) const
    {
        json result = begun("table", b);
        std::set<std::string> keys;
        for (const column& c : b.columns) {
            need(keys.insert(c.key).second, "two columns have the key " + c.key);
            json head{{"key", c.key}, {"label", c.label}};
            if (c.digits) head["digits"] = *c.digits;
            if (c.scale) head["scale"] = *c.scale;
            if (c.best != best::none) head["best"] = c.best == best::low ? "low" : "high";
            if (!c.hint.empty()) head["hint"] = c.hint;
            if (!c.colour.empty()) head["colour"] = c.colour;
            result["columns"].push_back(std::move(head));
        }
        result["rows"] = json::array();
        for (const table_row& row : b.rows) {
            json cells = json::object();
            for (const auto& [key, value] : row.cells) {
                need(keys.contains(key), fmt::format("a row has the key {}, which no column has", key));
                cells[key] = nullptr;
                if (const double* number = std::get_if<double>(&value)) cells[key] = finite(*number, key);
                if (const std::string* words = std::get_if<std::string>(&value)) cells[key] = *words;
            }
            if (!row.colour.empty()) cells["colour"] = row.colour;
            if (row.is_aside) cells["aside"] = true;
            result["rows"].push_back(std::move(cells));
        }
        return result;
    }

    json picture(const shown_picture& p) const
    {
        need(std::filesystem::is_regular_file(folder_ / p.file), fmt::format("no picture '{}'", p.file));
        need(!p.alt.empty(), p.file + " has no text for those who cannot see it");
        return {{"file", p.file}, {"alt", p.alt}, {"caption", p.caption}};
    }

    json written(const pictures_block& b) const
    {
        json result = begun("pictures", b);
        result["columns"] = b.columns;
        if (b.compare) result["compare"] = true;
        if (b.is_pixelated) result["pixelated"] = true;
        if (b.shown) result["shown"] = {b.shown->first, b.shown->second};
        for (const auto& [colour, label] : b.key) result["key"].push_back({{"colour", colour}, {"label", label}});
        for (const shown_picture& p : b.pictures) result["pictures"].push_back(picture(p));
        return result;
    }

    json drawn(const char* type, const auto& b)
    {
        need(!b.name.empty() && names_.insert(b.name).second,
             fmt::format("two charts or maps have the name '{}'", b.name));
        need(!b.alt.empty(), b.name + " has no text for those who cannot see it");
        json result = begun(type, b);
        result["name"] = b.name;
        result["alt"] = b.alt;
        if (!b.caption.empty()) result["caption"] = b.caption;
        return result;
    }

    json written(const axis& a) const
    {
        constexpr const char* scales[] = {"linear", "log", "symlog"};
        json result{{"label", a.label}, {"scale", scales[static_cast<int>(a.scale)]}};
        if (a.threshold) result["threshold"] = finite(*a.threshold, a.label);
        if (a.least) result["least"] = finite(*a.least, a.label);
        if (a.most) result["most"] = finite(*a.most, a.label);
        for (const auto& [value, text] : a.ticks) result["ticks"].push_back({finite(value, a.label), text});
        return result;
    }

    json points_of(const series& s) const
    {
        json result = json::array();
        for (const std::vector<double>& point : s.points) {
            need(point.size() == 2 || point.size() == 3, fmt::format("a point of {} is none", s.label));
            const bool is_rule = s.style == style::rule;
            need(!is_rule || std::isnan(point[0]) != std::isnan(point[1]), s.label + " is neither upright nor level");
            json one = json::array();
            for (const double value : point)
                one.push_back(is_rule && std::isnan(value) ? json() : json(finite(value, s.label)));
            result.push_back(std::move(one));
        }
        return result;
    }

    json written(const chart_block& b)
    {
        constexpr const char* styles[] = {"points", "line", "steps", "band", "rule"};
        json result = drawn("chart", b);
        if (b.is_front) result["front"] = true;
        for (const panel& p : b.panels) {
            json shown = json::object();
            if (!p.title.empty()) shown["title"] = p.title;
            shown["x"] = written(p.x);
            shown["y"] = written(p.y);
            if (p.pareto) shown["pareto"] = true;
            if (!p.size.empty()) shown["size"] = p.size;
            for (const series& s : p.series) {
                json one{{"label", s.label}};
                if (!s.colour.empty()) one["colour"] = s.colour;
                one["style"] = styles[static_cast<int>(s.style)];
                one["points"] = points_of(s);
                one["labelled"] = s.labelled;
                need(s.texts.empty() || s.texts.size() == s.points.size(),
                     fmt::format("{} has {} texts for {} points", s.label, s.texts.size(), s.points.size()));
                if (!s.texts.empty()) one["texts"] = s.texts;
                if (s.dashed) one["dashed"] = true;
                if (!s.marker.empty()) one["marker"] = s.marker;
                shown["series"].push_back(std::move(one));
            }
            result["panels"].push_back(std::move(shown));
        }
        return result;
    }

    json written(const map_axis& a) const
    {
        json result = written(a.along);
        for (const double value : a.values) result["values"].push_back(finite(value, a.along.label));
        return result;
    }

    json written(const map_block& b)
    {
        json result = drawn("map", b);
        result["x"] = written(b.x);
        result["y"] = written(b.y);
        result["threshold"] = finite(b.threshold, b.name);
        result["label"] = b.label;
        for (const map_layer& layer : b.maps) {
            json values = json::array();
            need(layer.values.size() == b.y.values.size(),
                 fmt::format("{} has {} rows for {} values of y", layer.label, layer.values.size(), b.y.values.size()));
            for (const auto& row : layer.values) {
                need(row.size() == b.x.values.size(),
                     fmt::format("{} has {} values for {} of x", layer.label, row.size(), b.x.values.size()));
                json line = json::array();
                for (const std::optional<double>& value : row)
                    line.push_back(value ? json(finite(*value, layer.label)) : json());
                values.push_back(std::move(line));
            }
            result["maps"].push_back({{"label", layer.label}, {"values", std::move(values)}});
        }
        return result;
    }

    std::filesystem::path folder_;
    std::set<std::string> names_;
};

} // namespace

std::string escaped(std::string_view text)
{
    std::string result;
    for (const char c : text) {
        if (c == '&') result += "&amp;";
        else if (c == '<') result += "&lt;";
        else if (c == '>') result += "&gt;";
        else if (c == '"') result += "&quot;";
        else result += c;
    }
    return result;
}

void write_page(const std::filesystem::path& folder, const page& what)
{
    renderer::write_file(folder / "facts.json", page_writer(folder)(what).dump(1) + "\n");
}

} // namespace gnomon::evaluation
