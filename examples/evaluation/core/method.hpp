// A method of shadowing as the registry knows it: its identity, and for methods that filter a shadow map of depths, how
// a map is built and looked up.
#pragma once

#include "depth_map.hpp"
#include "receivers.hpp"
#include "registry.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// Methods of one principle share a family: a colour in charts and a place among other families.
struct family {
    using kind = family;
    static constexpr const char* kind_name = "family";

    std::string id, label;
    double order = 0;
    std::string colour{}; // "#rrggbb"
};

// A kind of map, as rows of the report name it.
struct map_kind {
    using kind = map_kind;
    static constexpr const char* kind_name = "map";

    std::string id, label;
    double order = 0;
};

struct receiver_facts {
    std::string id, label;
    double order = 0;
    std::string marker{}; // in charts; see series
};

// A kind of receiver, as rows of the report name it.
class receiver_kind : public receiver_facts {
  public:
    using kind = receiver_kind;
    static constexpr const char* kind_name = "receiver";

    explicit receiver_kind(receiver_facts facts) : receiver_facts(std::move(facts)) {}
    receiver_kind(const receiver_kind&) = delete;
    receiver_kind& operator=(const receiver_kind&) = delete;
    virtual ~receiver_kind() = default;
};

using parameters = std::map<std::string, double>;

struct storage_facts {
    std::string id, label; // of the format of a texel
    double bytes_per_texel = 0;
};

struct method_facts {
    std::string id, family, label;
    double order = 0;  // within the family
    std::string map{}; // id of a map_kind
    storage_facts format{};
    evaluation::parameters parameters{};
};

class method : public method_facts {
  public:
    using kind = method;
    static constexpr const char* kind_name = "method";

    explicit method(method_facts facts) : method_facts(std::move(facts)) {}
    method(const method&) = delete;
    method& operator=(const method&) = delete;
    virtual ~method() = default;

    const evaluation::family& its_family() const { return registry_of<evaluation::family>().at(family); }
};

// All methods, by their families' orders, their own and their ids.
std::vector<const method*> methods_in_order();

// Something to time: run() puts the shadow intensities of the first `receivers` receivers into its argument.
struct timed_run {
    std::size_t receivers = 0;
    std::function<void(std::span<float>)> run;
};

// One way of computing: the kernel alone, from values that have been fetched, and the look-up, which fetches them first.
struct timed_look_up {
    int lanes = 1;
    timed_run kernel, look_up;
};

class shadow_map {
  public:
    virtual ~shadow_map() = default;

    virtual std::size_t bytes() const = 0; // with mip levels

    // Shadow intensity of one receiver after the other.
    virtual void intensities(std::span<const map_receiver> where, std::span<float> result) const = 0;

    // Runs to time, receiver by receiver, and by packs of them where the method has a kernel for packs. The map and the
    // receivers outlive what is returned.
    virtual std::vector<timed_look_up> timed(std::span<const map_receiver> where) const = 0;
};

// A method that looks up a map which is made from the depths of a multisampled shadow map.
class shadow_method : public method {
  public:
    using method::method;

    // The depths and the weights of the blur, taps, outlive the map.
    virtual std::unique_ptr<shadow_map> build(const depth_map& depths, std::span<const float> taps) const = 0;
};

// Storage and look-up of a method on a device: the one or two images of a texel, and the storage format's two kernels.
// CMake reads device forms in the files of methods and compiles the shaders of each.
struct device_image {
    std::string format; // as Vulkan-Hpp names it
    int channels;       // in use, from the first on
};
struct device_form {
    std::vector<device_image> images;
    std::string encode, intensity;
};

// A method whose map holds channels that may be averaged. Channels are those of a texel, as a texture unit returns them.
class filterable_method : public shadow_method {
  public:
    using channels = std::vector<float>;

    filterable_method(method_facts facts, std::optional<device_form> form)
        : shadow_method(std::move(facts)), device(std::move(form))
    {}

    // Channels of a texel that holds one depth, after rounding to the format.
    virtual channels from_depth(float z) const = 0;

    // Channels that are read back where a filter pass stores a mean.
    virtual channels store(const channels& mean) const = 0;

    virtual float intensity(const channels& filtered, float z_f) const = 0;

    const std::optional<device_form> device;
};

} // namespace gnomon::evaluation
