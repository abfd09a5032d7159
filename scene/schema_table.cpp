// SPDX-License-Identifier: MIT
#include "scene/schema_table.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/describe_scene.h"
#include "scene/nearest_name.h"

namespace spindrift::scene
{
namespace
{

/// Unit by the ending of a key's name, the longer endings first.
std::string_view unit_of(std::string_view name)
{
    constexpr std::pair<std::string_view, std::string_view> kUnits[] = {{"_w_sr_m2", "W/(sr m²)"},
                                                                        {"_cd_m2", "cd/m²"},
                                                                        {"_w_sr", "W/sr"},
                                                                        {"_w_m2", "W/m²"},
                                                                        {"_mm_h", "mm/h"},
                                                                        {"_g_m3", "g/m³"},
                                                                        {"_m_s", "m/s"},
                                                                        {"_per_s", "1/s"},
                                                                        {"_hz", "Hz"},
                                                                        {"_deg", "°"},
                                                                        {"_px", "px"},
                                                                        {"_m", "m"},
                                                                        {"_s", "s"}};
    for (const auto& [ending, unit] : kUnits)
        if (name.ends_with(ending)) return unit;
    return "";
}

std::string plain(double value)
{
    return std::isinf(value) ? "unlimited" : fmt::format("{:.6g}", value);
}

/// Writes one Markdown table per table of the file; inner tables come after the one that they are in.
class SchemaWriter final : public Section
{
  public:
    SchemaWriter(std::string& out, std::string path) : out_(out), path_(std::move(path)) {}

    bool number(const Key& key, const Range& range, double& value) override
    {
        return row(key, "number", allowed_numbers(range), plain(value));
    }
    bool number_or(const Key& key, const Range& range, std::string_view word, double& value,
                   bool& is_word) override
    {
        return row(key, "number or text", fmt::format("{}, or \"{}\"", allowed_numbers(range), word),
                   is_word ? quoted(word) : plain(value));
    }
    bool whole(const Key& key, const Range& range, std::uint64_t& value) override
    {
        return row(key, "whole number", allowed_numbers(range), fmt::format("{}", value));
    }
    bool flag(const Key& key, bool& value) override
    {
        return row(key, "true or false", "", value ? "true" : "false");
    }
    bool text(const Key& key, std::string& value) override { return row(key, "text", "", quoted(value)); }
    bool file(const Key& key, std::filesystem::path& value) override
    {
        return row(key, "path", "", quoted(value.string()));
    }
    bool triple(const Key& key, const Range& range, std::span<double, 3> value) override
    {
        return row(key, "three numbers", allowed_numbers(range),
                   fmt::format("[{}, {}, {}]", plain(value[0]), plain(value[1]), plain(value[2])));
    }
    bool choice(const Key& key, std::span<const std::string_view> names, std::size_t& index) override
    {
        return row(key, "text", listed(names), quoted(names[index]));
    }
    void require(bool, std::string_view, std::string_view, std::string_view) override {}

    void section(const Key& key, const std::function<void(Section&)>& describe) override
    {
        inner(key, describe, "[", "]");
    }
    void sections(const Key& key, const std::function<void(Section&)>& describe) override
    {
        inner(key, describe, "[[", "]]");
    }

    void finish()
    {
        if (!rows_.empty())
            out_ += "\n| key | type | unit | allowed | default | what |\n|---|---|---|---|---|---|\n" + rows_;
        out_ += later_;
    }

  private:
    static std::string quoted(std::string_view text)
    {
        return text.empty() ? "none" : fmt::format("\"{}\"", text);
    }

    bool row(const Key& key, std::string_view type, std::string_view allowed, std::string_view fallback)
    {
        const std::string when = key.applies_when.empty() ? "" : fmt::format("; only {}", key.applies_when);
        rows_ += fmt::format("| `{}` | {} | {} | {} | {} | {}{} |\n", key.name, type, unit_of(key.name),
                             allowed, key.required ? "required" : fallback, key.about, when);
        return false;
    }

    void inner(const Key& key, const std::function<void(Section&)>& describe, std::string_view open,
               std::string_view close)
    {
        const std::string path =
            path_.empty() ? std::string(key.name) : fmt::format("{}.{}", path_, key.name);
        std::string about(key.about);
        about.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(about.front())));
        later_ += fmt::format("\n### `{}{}{}`\n\n{}{}.\n", open, path, close, about,
                              key.required ? " (required)" : "");
        SchemaWriter table(later_, path);
        describe(table);
        table.finish();
    }

    std::string& out_;
    std::string path_;
    std::string rows_, later_;
};

}  // namespace

std::string schema_table()
{
    std::string out;
    SchemaWriter root(out, "");
    Scene scene;
    describe_scene(root, scene);
    root.finish();
    return out;
}

}  // namespace spindrift::scene
