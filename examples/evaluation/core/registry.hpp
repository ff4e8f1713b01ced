// Registries: each method, driver, scene and reference is an object with static storage in a file of its own, and enters
// the registry of its kind before main begins. No list elsewhere names them.
//
//     const registered<family> variance{family{.id = "vsm", .label = "variance shadow maps", ...}};
//
// A kind is a type with the members id, label and order, and the words for one of its kind, kind_name. The entries of
// derived classes enter the registry of their base class, which is their member type `kind`.
#pragma once

#include <algorithm>
#include <concepts>
#include <stdexcept>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace gnomon::evaluation {

// True for ids: letters from a to z, digits, and single underscores or hyphens between them, with a letter first.
inline bool is_id(std::string_view text)
{
    const auto letter = [](char c) { return 'a' <= c && c <= 'z'; };
    const auto joint = [](char c) { return c == '_' || c == '-'; };
    if (text.empty() || !letter(text.front()) || joint(text.back())) return false;
    if (std::ranges::adjacent_find(text, [&](char a, char b) { return joint(a) && joint(b); }) != text.end())
        return false;
    return std::ranges::all_of(text, [&](char c) { return letter(c) || ('0' <= c && c <= '9') || joint(c); });
}

template <class Kind> class registry {
  public:
    void add(const Kind& one) { entries_.push_back(&one); }

    // All entries by their order and, where that is equal, by their ids. Throws std::logic_error where an id is not one or
    // where two entries share one.
    std::vector<const Kind*> all() const
    {
        std::vector<const Kind*> result = entries_;
        std::ranges::sort(result, {},
                          [](const Kind* one) { return std::tuple(one->order, std::string_view(one->id)); });
        std::vector<std::string_view> ids;
        for (const Kind* one : result) {
            if (!is_id(one->id)) refuse("no id: ", one->id);
            ids.push_back(one->id);
        }
        std::ranges::sort(ids);
        if (const auto twin = std::ranges::adjacent_find(ids); twin != ids.end()) refuse("two have the id ", *twin);
        return result;
    }

    // Entries of a derived class, in the order of all().
    template <std::derived_from<Kind> Derived> std::vector<const Derived*> all_of() const
    {
        std::vector<const Derived*> result;
        for (const Kind* one : all())
            if (const auto* derived = dynamic_cast<const Derived*>(one)) result.push_back(derived);
        return result;
    }

    // The entry of this id, or a null pointer.
    const Kind* find(std::string_view id) const
    {
        const auto found = std::ranges::find(entries_, id, [](const Kind* one) { return std::string_view(one->id); });
        return found == entries_.end() ? nullptr : *found;
    }

    // The entry of this id. Throws std::invalid_argument where there is none.
    const Kind& at(std::string_view id) const
    {
        if (const Kind* one = find(id)) return *one;
        throw std::invalid_argument(std::string("no ").append(Kind::kind_name).append(" has the id ").append(id));
    }

  private:
    [[noreturn]] static void refuse(std::string_view why, std::string_view id)
    {
        throw std::logic_error(
            std::string("registry of kind ").append(Kind::kind_name).append(": ").append(why).append(id));
    }

    std::vector<const Kind*> entries_;
};

// The program's registry of one kind.
template <class Kind> registry<Kind>& registry_of()
{
    static registry<Kind> the_one;
    return the_one;
}

// An entry that is in the registry of its kind from its construction on.
template <class Entry> class registered {
  public:
    template <class... Arguments>
    explicit registered(Arguments&&... arguments) : entry_(std::forward<Arguments>(arguments)...)
    {
        registry_of<typename Entry::kind>().add(entry_);
    }
    registered(const registered&) = delete;
    registered& operator=(const registered&) = delete;

    const Entry& operator*() const { return entry_; }
    const Entry* operator->() const { return &entry_; }

  private:
    Entry entry_;
};

} // namespace gnomon::evaluation
