// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

#include "scene/section.h"

namespace spindrift::scene
{

/// A scene is a few kilobytes; more than this is not read.
inline constexpr std::size_t kMaxSceneBytes = 1024 * 1024;

/// A TOML text, parsed, with the place of every value. Hides the TOML library from everybody else.
class TomlDocument
{
  public:
    /// Throws Error "name:line: ..." for text that is not TOML, or that nests deeper than a scene ever does.
    TomlDocument(std::string_view text, const std::string& name);
    ~TomlDocument();
    TomlDocument(TomlDocument&&) noexcept;

    bool empty() const;

    using Value = std::variant<std::int64_t, double, std::string>;
    /// Sets [table] key as a command line would; errors about the value name the command line instead of a
    /// line.
    void set(std::string_view table, std::string_view key, const Value& value);
    /// The text at [table] key; "" if there is none.
    std::string text(std::string_view table, std::string_view key) const;
    /// Throws Error at the place of [table] key if `ok` is false.
    void require(bool ok, std::string_view table, std::string_view key, std::string_view why,
                 std::string_view allowed) const;

    /// Runs `describe` over the document twice: first only to find keys that it does not name (a slip in a
    /// name is a better answer than the missing key that follows from it), then to read and check every
    /// value. Throws Error for the first thing that is wrong.
    void read(const std::function<void(Section&)>& describe) const;

  private:
    struct Parsed;
    std::unique_ptr<Parsed> parsed_;
};

}  // namespace spindrift::scene
