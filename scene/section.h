// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "core/vec.h"
#include "scene/scene.h"

namespace spindrift::scene
{

/// What a scene file may say under one name. The text stands in error messages and in docs/scenes.md.
struct Key
{
    std::string_view name;   ///< ends in its unit where it has one
    std::string_view about;  ///< what it is, without a full stop
    bool required = false;
    bool applies = true;  ///< false: the rest of the table makes it meaningless, so giving it is an error
    std::string_view applies_when = {};  ///< that condition in words; empty: always
};

/// The numbers that a key takes.
struct Range
{
    double min = 0;
    double max = 0;
    bool above_min = false;         ///< min itself is not allowed
    std::string_view why = {};      ///< reason for the limits; empty: what the key is says enough
    std::string_view allowed = {};  ///< in words, where "min to max" does not say it
};

/// "0 to 150", "above 0 up to 150" or the range's own words.
std::string allowed_numbers(const Range& range);

/// A choice by name.
template <class E>
struct Named
{
    E value;
    std::string_view name;
};

/// One table of a scene file. describe_scene() names every key once through this interface; reading, the
/// search for unknown keys and the table of docs/scenes.md are implementations of it. What a value holds
/// before the call is the default. The functions that return bool say whether the file gives the key.
class Section
{
  public:
    virtual ~Section() = default;

    virtual bool number(const Key& key, const Range& range, double& value) = 0;
    /// A number, or one word in its place: `is_word` says which, and the word leaves `value` as it was.
    virtual bool number_or(const Key& key, const Range& range, std::string_view word, double& value,
                           bool& is_word) = 0;
    virtual bool whole(const Key& key, const Range& range, std::uint64_t& value) = 0;
    virtual bool flag(const Key& key, bool& value) = 0;
    virtual bool text(const Key& key, std::string& value) = 0;
    virtual bool file(const Key& key, std::filesystem::path& value) = 0;
    /// Three numbers: a point, a vector or a colour.
    virtual bool triple(const Key& key, const Range& range, std::span<double, 3> value) = 0;
    virtual bool choice(const Key& key, std::span<const std::string_view> names, std::size_t& index) = 0;

    /// A table [name]; a missing one leaves the defaults.
    virtual void section(const Key& key, const std::function<void(Section&)>& describe) = 0;
    /// An array of tables [[name]]; `describe` runs once for each.
    virtual void sections(const Key& key, const std::function<void(Section&)>& describe) = 0;

    /// A rule over several keys: throws at the place of `name` ("" for the table itself) if `ok` is false.
    virtual void require(bool ok, std::string_view name, std::string_view why, std::string_view allowed) = 0;

    bool number(const Key& key, const Range& range, float& value)
    {
        double wide = static_cast<double>(value);
        const bool given = number(key, range, wide);
        if (given) value = static_cast<float>(wide);
        return given;
    }

    bool whole(const Key& key, const Range& range, int& value)
    {
        auto wide = static_cast<std::uint64_t>(value);
        const bool given = whole(key, range, wide);
        value = static_cast<int>(wide);
        return given;
    }

    template <class R>
    bool triple(const Key& key, const Range& range, Vec3<R>& value)
    {
        std::array<double, 3> wide{value.x, value.y, value.z};
        const bool given = triple(key, range, std::span(wide));
        value = {static_cast<R>(wide[0]), static_cast<R>(wide[1]), static_cast<R>(wide[2])};
        return given;
    }

    bool triple(const Key& key, const Range& range, Colour& value)
    {
        Vec3f rgb{value.r, value.g, value.b};
        const bool given = triple(key, range, rgb);
        value = {rgb.x, rgb.y, rgb.z};
        return given;
    }

    template <class E, std::size_t N>
    bool choice(const Key& key, const std::array<Named<E>, N>& named, E& value)
    {
        std::array<std::string_view, N> names;
        std::size_t index = 0;
        for (std::size_t i = 0; i < N; ++i)
        {
            names[i] = named[i].name;
            if (named[i].value == value) index = i;
        }
        const bool given = choice(key, std::span<const std::string_view>(names), index);
        value = named[index].value;
        return given;
    }
};

}  // namespace spindrift::scene
