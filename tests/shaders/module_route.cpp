#include "module.hpp"
#include "route.hpp"
#include "support/kernel_call.hpp"

#include <dlfcn.h>

#include <string_view>

namespace gnomon::parity {

namespace {

class module final : public route {
  public:
    explicit module(const std::filesystem::path& file, bool against_split) : against_split_(against_split)
    {
        if (!exists(file)) throw unavailable(file.filename().string() + " was not built");
        library_.reset(dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL));
        if (!library_) throw std::runtime_error(dlerror());
        run_ = reinterpret_cast<decltype(&parity_run)>(dlsym(library_.get(), "parity_run"));
        const auto device = reinterpret_cast<decltype(&parity_device)>(dlsym(library_.get(), "parity_device"));
        if (run_ == nullptr || device == nullptr) throw std::runtime_error(file.string() + ": not as in module.hpp");
        const std::string_view words = device();
        const std::size_t space = words.find(' ');
        kind_ = words.substr(0, space);
        device_ = words.substr(space + 1);
        if (kind_ == "unavailable") throw unavailable(device_);
    }

    void run(const kernel& k, std::span<const float> in, std::span<float> out) override
    {
        if (!run_(k.name, in.size() / (k.inputs * test::block_rows), in.data(), out.data()))
            throw std::runtime_error(std::string("no ") + k.name);
    }
    std::string device() const override { return device_; }
    products computes() const override
    {
        if (against_split_) return products::fused_against_split;
        return kind_ == "fused" ? products::fused : products::split;
    }

  private:
    struct close {
        void operator()(void* library) const { dlclose(library); }
    };
    bool against_split_;
    std::unique_ptr<void, close> library_;
    decltype(&parity_run) run_ = nullptr;
    std::string kind_, device_;
};

} // namespace

std::unique_ptr<route> module_route(const std::filesystem::path& file) { return std::make_unique<module>(file, false); }

std::unique_ptr<route> fused_against_split_route(const std::filesystem::path& file)
{
    return std::make_unique<module>(file, true);
}

} // namespace gnomon::parity
