#include "route.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>

namespace gnomon::parity {

namespace {

class command final : public route {
  public:
    command(std::string line, std::string device) : line_(std::move(line)), device_(std::move(device)) {}
    ~command() override
    {
        std::error_code ignored;
        remove_all(folder_, ignored);
    }

    void run(const kernel& k, std::span<const float> in, std::span<float> out) override
    {
        create_directories(folder_);
        const auto from = folder_ / "in", to = folder_ / "out";
        std::ofstream(from, std::ios::binary)
            .write(reinterpret_cast<const char*>(in.data()), std::streamsize(in.size_bytes()));
        const std::string call = line_ + ' ' + k.name + ' ' + std::to_string(k.inputs) + ' ' +
                                 std::to_string(k.outputs) + " '" + from.string() + "' '" + to.string() + '\'';
        const int status = std::system(call.c_str());
        if (WIFEXITED(status) && WEXITSTATUS(status) == 77) throw unavailable(device_ + " is not to be had");
        std::ifstream result(to, std::ios::binary);
        result.read(reinterpret_cast<char*>(out.data()), std::streamsize(out.size_bytes()));
        if (status != 0 || !result) throw std::runtime_error("failed: " + call);
    }
    std::string device() const override { return device_; }

  private:
    std::string line_, device_;
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("gnomon-parity-" + std::to_string(getpid()));
};

} // namespace

std::unique_ptr<route> command_route(std::string line, std::string device)
{
    return std::make_unique<command>(std::move(line), std::move(device));
}

} // namespace gnomon::parity
