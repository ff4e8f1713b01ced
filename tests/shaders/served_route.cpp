// Kernels by a program that stays: what starts slowly, such as a browser, starts once.
#include "route.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>

namespace gnomon::parity {

namespace {

/// A shell's command with pipes to its standard input and from its standard output.
class process {
  public:
    explicit process(const std::string& line)
    {
        int in[2], out[2];
        if (pipe(in) != 0 || pipe(out) != 0) throw std::runtime_error("no pipe");
        signal(SIGPIPE, SIG_IGN); // a program that has ended is told by its silence
        child_ = fork();
        if (child_ == 0) {
            dup2(in[0], STDIN_FILENO);
            dup2(out[1], STDOUT_FILENO);
            for (const int end : {in[0], in[1], out[0], out[1]}) close(end);
            execl("/bin/sh", "sh", "-c", ("exec " + line).c_str(), nullptr);
            _exit(127);
        }
        close(in[0]);
        close(out[1]);
        to_ = fdopen(in[1], "w");
        from_ = fdopen(out[0], "r");
    }
    process(const process&) = delete;
    process& operator=(const process&) = delete;
    ~process()
    {
        std::fclose(to_);
        std::fclose(from_);
        waitpid(child_, nullptr, 0);
    }

    void say(const std::string& line)
    {
        std::fputs((line + '\n').c_str(), to_);
        std::fflush(to_);
    }
    /// The next line, empty where the program has ended.
    std::string heard()
    {
        std::string line;
        for (int c = std::fgetc(from_); c != EOF && c != '\n'; c = std::fgetc(from_)) line += char(c);
        return line;
    }

  private:
    pid_t child_ = -1;
    std::FILE *to_ = nullptr, *from_ = nullptr;
};

class served final : public route {
  public:
    explicit served(const std::string& line) : line_(line), program_(line)
    {
        const std::string heard = program_.heard(), ready = "ready ";
        if (!heard.starts_with(ready))
            throw unavailable(heard.empty() ? line + " ends without a word" : heard.substr(heard.find(' ') + 1));
        device_ = heard.substr(ready.size());
    }
    served(const served&) = delete;
    served& operator=(const served&) = delete;
    ~served() override
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
        program_.say(std::string(k.name) + ' ' + std::to_string(k.inputs) + ' ' + std::to_string(k.outputs) + ' ' +
                     from.string() + ' ' + to.string());
        const std::string heard = program_.heard();
        std::ifstream result(to, std::ios::binary);
        result.read(reinterpret_cast<char*>(out.data()), std::streamsize(out.size_bytes()));
        if (heard != "done" || !result) throw std::runtime_error(line_ + ", " + k.name + ": " + heard);
    }
    std::string device() const override { return device_; }

  private:
    std::string line_, device_;
    process program_;
    std::filesystem::path folder_ =
        std::filesystem::temp_directory_path() / ("gnomon-served-" + std::to_string(getpid()));
};

} // namespace

std::unique_ptr<route> served_route(const std::string& line) { return std::make_unique<served>(line); }

} // namespace gnomon::parity
