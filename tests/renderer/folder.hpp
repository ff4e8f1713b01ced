// A folder of its own for each test that writes, gone when the test ends.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <string>

struct temporary_folder {
    std::filesystem::path path = std::filesystem::temp_directory_path() / ("gnomon-" + std::to_string(getpid()));

    temporary_folder() { std::filesystem::create_directories(path); }
    ~temporary_folder() { std::filesystem::remove_all(path); }
    temporary_folder(const temporary_folder&) = delete;
    temporary_folder& operator=(const temporary_folder&) = delete;
    std::filesystem::path operator/(const char* name) const { return path / name; }
};
