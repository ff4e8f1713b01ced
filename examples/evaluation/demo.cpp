// The program behind ./run demo.
#include "evaluation/core/driver.hpp"
#include "evaluation/core/registry_facts.hpp"
#include "evaluation/core/report.hpp"
#include "renderer/import/model.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <iterator>
#include <string>
#include <vector>

namespace {

// The words of the command line, the last one first, as CLI11 wants them. It takes the next word for the value of
// "--name=", so that an empty value is given as a word of its own.
std::vector<std::string> words_of(int argc, char** argv)
{
    std::vector<std::string> words;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const bool is_empty = word.starts_with("--") && word.ends_with("=") && word.find('=') == word.size() - 1;
        words.push_back(is_empty ? word.substr(0, word.size() - 1) : word);
        if (is_empty) words.emplace_back();
    }
    std::ranges::reverse(words);
    return words;
}

} // namespace

int main(int argc, char** argv)
try {
    using namespace gnomon::evaluation;
    settings how;
    std::vector<std::string> names;
    std::string out = how.out.string(), model;
    bool full = false, tiny = false, registry = false;

    CLI::App app("Renders shadows by every method of Gnomon; with no argument all drivers run.", "./run demo");
    const std::string facts = registry_facts(); // refuses ids that two share
    const std::vector<const driver*> drivers = registry_of<driver>().all();
    std::vector<std::string> known;
    for (const driver* d : drivers)
        if (d->of == subject::own) known.push_back(d->id);
    app.add_option("NAME", names, "drivers to run")->check(CLI::IsMember(known));
    app.add_flag("--full", full, "four camera samples per pixel");
    app.add_flag("--tiny", tiny, "a quarter of the size, for tests")->excludes("--full");
    app.add_flag("--hlsl", how.hlsl, "vulkan_shadows: shaders from HLSL instead of GLSL");
    CLI::Option* still =
        app.add_option("--model", model, "OBJ, PLY, glTF or similar, put on a ground plane and shaded by every method");
    const CLI::Option* moving =
        app.add_option("--animation", how.model.animation,
                       "the model in motion, by its animation NAME; '' is the first that it has")
            ->type_name("NAME")
            ->needs(still);
    const CLI::Option* exposed =
        app.add_option("--shutter", how.model.shutter,
                       "the model in motion, from T0 to T1 seconds after its animation starts; "
                       "a frame of film, 0 to 1/24, where it is not given")
            ->type_name("T0,T1")
            ->delimiter(',')
            ->needs(still);
    app.add_flag("--registry", registry, "print ids of methods, scenes, drivers and the like as JSON, run nothing");
    app.add_option("--out", out, "folder for the gallery and report.json")->capture_default_str();
    try {
        app.parse(words_of(argc, argv));
    } catch (const CLI::ParseError& error) {
        if (error.get_exit_code() == 0) return app.exit(error);
        fmt::print(stderr, "demo: {}\n", error.what());
        return 2;
    }
    if (registry) {
        fmt::print("{}\n", facts);
        return 0;
    }
    if (full) how.supersampling = 2;
    if (tiny) how.width /= 4, how.height /= 4, how.map_resolution /= 4;
    how.out = out;
    std::filesystem::create_directories(how.out / "gallery");

    how.model.file = model;
    const auto is_named = [&](const std::string& id) { return std::ranges::count(names, id) > 0; };
    // A driver that is named shows the model in place of its scenes, if another one does so for it.
    const bool from_file = still->count() > 0;
    const auto is_replaced = [&](const std::string& id) {
        return from_file && std::ranges::any_of(drivers, [&](const driver* d) { return d->scenes_of == id; });
    };
    const bool in_motion = moving->count() > 0 || exposed->count() > 0 || std::ranges::any_of(names, is_replaced);
    const bool is_own = std::ranges::none_of(names, is_replaced);
    const auto is_asked_for = [&](const driver& d) {
        if (d.of == subject::animation) return in_motion && (is_own || is_named(d.scenes_of));
        if (d.of == subject::model) return from_file && !in_motion;
        return names.empty() ? !from_file : is_named(d.id) && !is_replaced(d.id);
    };
    std::vector<const driver*> wanted;
    std::ranges::copy_if(drivers, std::back_inserter(wanted), [&](const driver* d) { return is_asked_for(*d); });
    // A model that cannot be read is refused before a driver speaks.
    if (std::ranges::any_of(wanted, [](const driver* d) { return d->of == subject::model; }))
        gnomon::renderer::load_model(model);
    if (std::ranges::any_of(wanted, [](const driver* d) { return d->of == subject::animation; }))
        gnomon::renderer::load_animated_model(model, how.model.animation, how.model.shutter[0], how.model.shutter[1]);
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        if (wanted.size() > 1) progress(wanted[i]->id, fmt::format("driver {} of {}", i + 1, wanted.size()));
        wanted[i]->run(how);
    }
    merge_report(how.out / "report.json", {}); // the gallery wants one, and not every driver has rows
    return 0;
} catch (const std::exception& error) {
    fmt::print(stderr, "demo: {}\n", error.what());
    return 2;
}
