// Numbers in texts for people.
#pragma once

#include <string>

namespace gnomon::evaluation {

// Rounded to so many digits after the decimal point, with a comma between thousands: 12,345.7.
std::string grouped(double value, int digits = 0);

// A speed: 1/32 or 4.
std::string ratio(double value);

// A factor in words: 3.4 x or 12 x.
std::string so_many(double times);

} // namespace gnomon::evaluation
