// Rows of inputs for any kernel, by the families in kernels.txt (input_families.hpp). Every run draws the same rows. Of four
// blocks of 64 rows
//     two    are drawn from the families, in the domain of the kernel
//     one    also, but with one number replaced: by a special number, by any bits, or by itself with a small error
//     one    has only special numbers or only any bits
#pragma once

#include "input_families.hpp"
#include "kernel_call.hpp"

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>
#include <vector>

namespace gnomon::test {

/// The kind of rows to draw: every kind in turn, only rows in the domain of the kernel, or only the others.
enum class row_kind { all, tame, hostile };

/// The rows of one kernel.
template <class T> class kernel_inputs {
  public:
    /// families are the words of kernels.txt, which must give as many numbers as stated.
    kernel_inputs(std::string_view kernel, std::string_view families, std::size_t numbers)
        : bits_(std::hash<std::string_view>{}(kernel)), special_(bits_()), numbers_(numbers)
    {
        std::istringstream words{std::string(families)};
        std::size_t given = 0;
        for (std::string word; words >> word;) {
            const input_family<T>* found = find_family<T>(word);
            if (found == nullptr) wrong(kernel, "there is no family " + word);
            families_.push_back(found);
            given += found->numbers;
            informs_.resize(given, word != "texels"); // of which a NaN names a default
        }
        if (given != numbers)
            wrong(kernel, "needs " + std::to_string(numbers) + " numbers, its families give " + std::to_string(given));
    }

    /// Draws the next blocks, in the layout of kernel_call.hpp.
    void draw(std::size_t blocks, T* to, row_kind kind = row_kind::all)
    {
        std::vector<T> row(numbers_);
        for (std::size_t end = block_ + blocks; block_ < end; ++block_, to += block_rows * numbers_)
            for (std::size_t i = 0; i < block_rows; ++i) {
                draw_row(row, kind == row_kind::all ? block_ % 4 : kind == row_kind::tame ? 0 : 2 + block_ % 2);
                for (std::size_t j = 0; j < numbers_; ++j) to[j * block_rows + i] = row[j];
            }
    }

    /// Whether a number that informs is NaN, which a kernel answers by lit.
    [[nodiscard]] bool lacks_information(const std::vector<T>& row) const
    {
        for (std::size_t j = 0; j < row.size(); ++j)
            if (informs_[j] && std::isnan(row[j])) return true;
        return false;
    }

  private:
    [[noreturn]] static void wrong(std::string_view kernel, const std::string& what)
    {
        std::fprintf(stderr, "kernels.txt: %s: %s\n", std::string(kernel).c_str(), what.c_str());
        std::exit(2);
    }

    void draw_row(std::vector<T>& row, std::size_t turn)
    {
        static const std::vector<situation> situations = draw_situations(std::size_t{1} << 16, 7);
        const situation& s = situations[bits_.below(situations.size())];
        T* at = row.data();
        for (const auto* family : families_) {
            family->draw(row_writer<T>(at), s, bits_);
            at += family->numbers;
        }
        if (turn == 2) {
            const std::size_t j = bits_.below(numbers_);
            row[j] = another(row[j]);
        } else if (turn == 3) {
            const bool special = bits_.chance(0.5);
            for (T& x : row) x = special ? special_.special() : special_.pattern();
        }
    }

    T another(T x)
    {
        switch (bits_.below(3)) {
            case 0:
                return special_.special();
            case 1:
                return special_.pattern();
            default:
                return T(double(x) * (1 + std::ldexp(bits_.uniform(-1, 1), -int(bits_.below(30)))));
        }
    }

    bit_source bits_;
    hostile_source<T> special_;
    std::size_t numbers_, block_ = 0;
    std::vector<const input_family<T>*> families_;
    std::vector<bool> informs_;
};

} // namespace gnomon::test
