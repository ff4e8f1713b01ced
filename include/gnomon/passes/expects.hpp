// Checks of a pass's arguments, before the pass writes anything. GNOMON_EXPECTS throws std::invalid_argument, or prints
// and aborts if exceptions are off. Define the macro before inclusion to replace it; a replacement must not return if
// the condition is false.
#ifndef GNOMON_PASSES_EXPECTS_HPP
#define GNOMON_PASSES_EXPECTS_HPP

#include "../portable.h"
#include "../portable/cpp_only.h"

#include <cstddef>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <string_view>

#if !defined(GNOMON_EXPECTS)
#if defined(__cpp_exceptions)
#define GNOMON_EXPECTS(condition, message)                      \
    do {                                                        \
        if (!(condition)) throw std::invalid_argument(message); \
    } while (false)
#else
#define GNOMON_EXPECTS(condition, message)                              \
    do {                                                                \
        if (!(condition)) {                                             \
            std::fprintf(stderr, "%s\n", std::string(message).c_str()); \
            std::abort();                                               \
        }                                                               \
    } while (false)
#endif
#endif

GNOMON_NAMESPACE_BEGIN

/// Message for two arguments that do not fit: "gnomon: blur: target.width is 4, but source.width is 5".
inline std::string mismatch(std::string_view pass, std::string_view first, std::size_t first_value,
                            std::string_view second, std::size_t second_value)
{
    std::string text = "gnomon: ";
    text.append(pass).append(": ").append(first).append(" is ").append(std::to_string(first_value));
    return text.append(", but ").append(second).append(" is ").append(std::to_string(second_value));
}

GNOMON_NAMESPACE_END
#endif
