// Small glTF files, written by tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace gnomon::test {

inline std::string base64(std::string_view bytes)
{
    constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t bits = 0;
        for (std::size_t k = 0; k < 3; ++k)
            bits = bits << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k) text += i + k <= bytes.size() ? digits[bits >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

// glTF text whose numbers, all floats or 16-bit indices, are views of one buffer.
class gltf {
  public:
    // Adds an accessor and returns its index.
    int floats(std::string_view type, std::size_t components, const std::vector<float>& values)
    {
        return add(type, 5126, components, values);
    }
    int shorts(std::string_view type, std::size_t components, const std::vector<std::uint16_t>& values)
    {
        return add(type, 5123, components, values);
    }

    std::string text(const std::string& nodes_meshes_and_so_on) const
    {
        return R"({"asset":{"version":"2.0"},"scene":0,)" + nodes_meshes_and_so_on + R"(,"accessors":[)" + accessors_ +
               R"(],"bufferViews":[)" + views_ + R"(],"buffers":[{"byteLength":)" + std::to_string(bytes_.size()) +
               R"(,"uri":"data:application/octet-stream;base64,)" + base64(bytes_) + R"("}]})";
    }

  private:
    template <class T>
    int add(std::string_view type, int component, std::size_t components, const std::vector<T>& values)
    {
        const std::string comma = count_ > 0 ? "," : "", index = std::to_string(count_);
        const std::size_t size = values.size() * sizeof(T);
        views_ += comma + R"({"buffer":0,"byteOffset":)" + std::to_string(bytes_.size()) + R"(,"byteLength":)" +
                  std::to_string(size) + "}";
        accessors_ += comma + R"({"bufferView":)" + index + R"(,"componentType":)" + std::to_string(component) +
                      R"(,"count":)" + std::to_string(values.size() / components) + R"(,"type":")" + std::string(type) +
                      R"("})";
        bytes_.append(reinterpret_cast<const char*>(values.data()), size);
        bytes_.resize((bytes_.size() + 3) / 4 * 4);
        return count_++;
    }

    int count_ = 0;
    std::string accessors_, views_, bytes_;
};

} // namespace gnomon::test
