// SPDX-License-Identifier: MIT
#include "scene/toml_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/error.h"
#include "scene/nearest_name.h"

// The only place that sees the TOML library. Values nest at most five deep in a scene; a low limit keeps
// hostile files from exhausting the stack.
#define TOML_EXCEPTIONS 1
#define TOML_HEADER_ONLY 1
#define TOML_ENABLE_FORMATTERS 0
#define TOML_MAX_NESTED_VALUES 16
#include <toml++/toml.h>

namespace spindrift::scene
{
namespace
{

/// Dotted keys nest without limit in the TOML library, which walks them recursively.
constexpr std::ptrdiff_t kMaxDotsPerLine = 200;
/// Numbers nearer to 0 than this are meant to be 0 and would vanish in single precision.
constexpr double kLeastMagnitude = 1e-30;

/// One line, no control characters, cut after about `limit` bytes but never inside a character.
std::string printable(std::string_view text, std::size_t limit)
{
    std::string line;
    for (std::size_t i = 0; i < text.size(); ++i)
    {
        const auto byte = static_cast<unsigned char>(text[i]);
        const bool starts_character = (byte & 0xC0U) != 0x80U;
        if (line.size() >= limit && starts_character) return line + "...";
        line += byte < 0x20U || byte == 0x7FU ? '?' : text[i];
    }
    return line;
}

std::string value_text(const toml::node& node);

std::string array_text(const toml::array& array)
{
    constexpr std::size_t kMostElements = 8;
    std::string text = "[";
    for (std::size_t i = 0; i < array.size() && i < kMostElements; ++i)
        text += (i > 0 ? ", " : "") + value_text(array[i]);
    return text + (array.size() > kMostElements ? ", ...]" : "]");
}

std::string value_text(const toml::node& node)
{
    if (const auto* value = node.as_integer()) return fmt::format("{}", value->get());
    if (const auto* value = node.as_floating_point()) return fmt::format("{}", value->get());
    if (const auto* value = node.as_boolean()) return value->get() ? "true" : "false";
    if (const auto* value = node.as_string()) return fmt::format("\"{}\"", printable(value->get(), 60));
    if (const auto* array = node.as_array()) return array_text(*array);
    return node.is_table() ? "{...}" : "a date or time";
}

std::string_view kind_of(const toml::node& node)
{
    if (node.is_integer() || node.is_floating_point()) return "a number";
    if (node.is_boolean()) return "true or false";
    if (node.is_string()) return "a text";
    if (node.is_array()) return "a list";
    return node.is_table() ? "a table" : "a date or time";
}

/// A table of the document as errors name it: "camera.key[2]", numbers counted from 1.
struct Place
{
    const toml::table& table;
    const toml::source_region& source;  ///< of the table; of the one around it if the file leaves it out
    std::string path;
    const std::string& file;

    std::string name_of(std::string_view key) const
    {
        const std::string name = printable(key, 60);
        return path.empty() ? name : (key.empty() ? path : path + "." + name);
    }

    [[noreturn]] void fail(const toml::source_region& where, const std::string& message) const
    {
        // values that a command line set have no line
        if (where.begin.line == 0 && !path.empty()) throw Error("command line: " + message);
        throw Error(fmt::format("{}:{}: {}", file, std::max<unsigned>(1, where.begin.line), message));
    }

    [[noreturn]] void fail_value(const Key& key, const toml::node& node, std::string_view wrong,
                                 std::string_view why, std::string_view allowed) const
    {
        fail(node.source(), fmt::format("{} = {} is {} ({}); {}", name_of(key.name), value_text(node), wrong,
                                        why.empty() ? key.about : why, allowed));
    }
};

/// First reading: only the names. Finds keys that the description does not name.
class UnknownKeyFinder final : public Section
{
  public:
    explicit UnknownKeyFinder(Place place) : place_(std::move(place)) {}

    bool number(const Key& key, const Range&, double&) override { return note(key); }
    bool whole(const Key& key, const Range&, std::uint64_t&) override { return note(key); }
    bool flag(const Key& key, bool&) override { return note(key); }
    bool text(const Key& key, std::string&) override { return note(key); }
    bool file(const Key& key, std::filesystem::path&) override { return note(key); }
    bool triple(const Key& key, const Range&, std::span<double, 3>) override { return note(key); }
    bool choice(const Key& key, std::span<const std::string_view>, std::size_t&) override
    {
        return note(key);
    }
    void require(bool, std::string_view, std::string_view, std::string_view) override {}

    void section(const Key& key, const std::function<void(Section&)>& describe) override
    {
        note(key);
        if (const auto* table = place_.table[key.name].as_table())
            search(*table, place_.name_of(key.name), describe);
    }

    void sections(const Key& key, const std::function<void(Section&)>& describe) override
    {
        note(key);
        const auto* array = place_.table[key.name].as_array();
        for (std::size_t i = 0; array && i < array->size(); ++i)
        {
            const auto* table = (*array)[i].as_table();
            if (table) search(*table, fmt::format("{}[{}]", place_.name_of(key.name), i + 1), describe);
        }
    }

    void finish() const
    {
        for (const auto& [key, node] : place_.table)
            if (std::find(known_.begin(), known_.end(), key.str()) == known_.end()) fail(key, node);
    }

  private:
    bool note(const Key& key)
    {
        known_.push_back(key.name);
        return false;
    }

    void search(const toml::table& table, const std::string& path,
                const std::function<void(Section&)>& describe) const
    {
        UnknownKeyFinder inner({table, table.source(), path, place_.file});
        describe(inner);
        inner.finish();
    }

    [[noreturn]] void fail(const toml::key& key, const toml::node& node) const
    {
        const std::string_view nearest = nearest_name(key.str(), known_);
        const std::string value =
            node.is_table() || node.is_array_of_tables() ? "" : " = " + value_text(node);
        const std::string hint = nearest.empty() ? "nothing here is called so"
                                                 : "the nearest known one is " + place_.name_of(nearest);
        place_.fail(key.source(), fmt::format("{}{} is not known ({}); use {}", place_.name_of(key.str()),
                                              value, hint, listed(known_)));
    }

    Place place_;
    std::vector<std::string_view> known_;
};

/// Second reading: the values.
class Reader final : public Section
{
  public:
    explicit Reader(Place place) : place_(std::move(place)) {}

    bool number(const Key& key, const Range& range, double& value) override
    {
        const std::string allowed = "use " + allowed_numbers(range);
        const toml::node* node = find(key, allowed);
        if (node) value = checked(key, range, *node, *node, allowed);
        return node;
    }

    bool whole(const Key& key, const Range& range, std::uint64_t& value) override
    {
        const std::string allowed = "use a whole number, " + allowed_numbers(range);
        const toml::node* node = find(key, allowed);
        if (!node) return false;
        const double number = checked(key, range, *node, *node, allowed);
        if (number != std::floor(number)) place_.fail_value(key, *node, "not a whole number", {}, allowed);
        const auto* integer = node->as_integer();
        value = static_cast<std::uint64_t>(integer ? integer->get() : static_cast<std::int64_t>(number));
        return true;
    }

    bool flag(const Key& key, bool& value) override { return typed<bool>(key, value, "use true or false"); }
    bool text(const Key& key, std::string& value) override
    {
        return typed(key, value, "use a text in quotes");
    }

    bool file(const Key& key, std::filesystem::path& value) override
    {
        constexpr std::string_view kAllowed = "use the path of a file, absolute or from the scene's folder";
        std::string text;
        if (!typed(key, text, kAllowed)) return false;
        if (text.empty() || text.find('\0') != std::string::npos)
            place_.fail_value(key, *place_.table.get(key.name), "not a path", {}, kAllowed);
        value = text;
        return true;
    }

    bool triple(const Key& key, const Range& range, std::span<double, 3> value) override
    {
        const std::string allowed =
            fmt::format("use three numbers [a, b, c], each {}", allowed_numbers(range));
        const toml::node* node = find(key, allowed);
        if (!node) return false;
        const auto* array = node->as_array();
        if (!array) place_.fail_value(key, *node, fmt::format("{}, not a list", kind_of(*node)), {}, allowed);
        if (array->size() != value.size())
            place_.fail_value(key, *node, fmt::format("a list of {}, not of 3", array->size()), {}, allowed);
        for (std::size_t i = 0; i < value.size(); ++i)
            value[i] = checked(key, range, (*array)[i], *node, allowed);
        return true;
    }

    bool choice(const Key& key, std::span<const std::string_view> names, std::size_t& index) override
    {
        const std::string allowed = "use " + listed(names);
        std::string name;
        if (!typed(key, name, allowed)) return false;
        const auto found = std::find(names.begin(), names.end(), name);
        if (found == names.end())
        {
            const std::string_view nearest = nearest_name(name, names);
            const std::string hint =
                nearest.empty() ? std::string(key.about) : fmt::format("nearest: {}", nearest);
            place_.fail_value(key, *place_.table.get(key.name), "not among the choices", hint, allowed);
        }
        index = static_cast<std::size_t>(found - names.begin());
        return true;
    }

    void section(const Key& key, const std::function<void(Section&)>& describe) override
    {
        const std::string allowed = fmt::format("write [{}]", place_.name_of(key.name));
        const toml::node* node = find(key, allowed);
        const toml::table nothing;
        if (node && !node->is_table())
            place_.fail_value(key, *node, fmt::format("{}, not a table", kind_of(*node)), {}, allowed);
        Reader inner({node ? *node->as_table() : nothing, node ? node->source() : place_.source,
                      place_.name_of(key.name), place_.file});
        describe(inner);
    }

    void sections(const Key& key, const std::function<void(Section&)>& describe) override
    {
        const std::string allowed = fmt::format("write [[{}]]", place_.name_of(key.name));
        const toml::node* node = find(key, allowed);
        if (!node) return;
        const auto* array = node->as_array();
        if (!array)
            place_.fail_value(key, *node, fmt::format("{}, not a list of tables", kind_of(*node)), {},
                              allowed);
        for (std::size_t i = 0; i < array->size(); ++i)
        {
            const auto* table = (*array)[i].as_table();
            if (!table)
                place_.fail_value(key, (*array)[i], fmt::format("{}, not a table", kind_of((*array)[i])), {},
                                  allowed);
            Reader inner({*table, table->source(), fmt::format("{}[{}]", place_.name_of(key.name), i + 1),
                          place_.file});
            describe(inner);
        }
    }

    void require(bool ok, std::string_view name, std::string_view why, std::string_view allowed) override
    {
        if (ok) return;
        const toml::node* node = name.empty() ? nullptr : place_.table.get(name);
        const toml::source_region& where = node ? node->source() : place_.source;
        const bool scalar = node && !node->is_table() && !node->is_array_of_tables();
        const std::string value = scalar ? " = " + value_text(*node) : "";
        place_.fail(where, fmt::format("{}{} {}; {}", place_.name_of(name), value, why, allowed));
    }

  private:
    /// The node of a key; null when it is not given and need not be.
    const toml::node* find(const Key& key, std::string_view allowed) const
    {
        const toml::node* node = place_.table.get(key.name);
        if (!node && key.required && key.applies)
        {
            place_.fail(place_.source,
                        fmt::format("{} is missing ({}); {}", place_.name_of(key.name), key.about, allowed));
        }
        if (node && !key.applies)
        {
            const bool table = node->is_table() || node->is_array_of_tables();
            place_.fail(node->source(),
                        fmt::format("{}{} has no effect here (it counts only {}); remove it, or make that so",
                                    place_.name_of(key.name), table ? "" : " = " + value_text(*node),
                                    key.applies_when));
        }
        return node;
    }

    template <class T>
    bool typed(const Key& key, T& value, std::string_view allowed) const
    {
        const toml::node* node = find(key, allowed);
        if (!node) return false;
        const auto* found = node->as<T>();
        const std::string_view wanted = std::is_same_v<T, bool> ? "true or false" : "a text";
        if (!found)
            place_.fail_value(key, *node, fmt::format("{}, not {}", kind_of(*node), wanted), {}, allowed);
        value = found->get();
        return true;
    }

    /// A number in range; `shown` is what the error prints (the whole list, for one of its elements).
    double checked(const Key& key, const Range& range, const toml::node& node, const toml::node& shown,
                   std::string_view allowed) const
    {
        const auto fail = [&](std::string_view wrong, std::string_view why)
        { place_.fail_value(key, shown, wrong, why, allowed); };
        if (!node.is_number()) fail(fmt::format("{}, not a number", kind_of(node)), {});
        const double number = node.is_integer() ? static_cast<double>(node.as_integer()->get())
                                                : node.as_floating_point()->get();
        if (std::isnan(number)) fail("not a number", {});
        if (std::isinf(number)) fail("not finite", {});
        if (number != 0 && std::abs(number) < kLeastMagnitude)
            fail("too near 0 to count", "it vanishes in single precision");
        if (number < range.min) fail(fmt::format("below {}", range.min), range.why);
        if (range.above_min && number == range.min) fail(fmt::format("not above {}", range.min), range.why);
        if (number > range.max) fail(fmt::format("above {}", range.max), range.why);
        return number;
    }

    Place place_;
};

/// Throws for a text that the TOML library should not be given.
void check_text(std::string_view text, const std::string& name)
{
    if (text.size() > kMaxSceneBytes)
        throw Error(
            fmt::format("{}:1: the file holds {} bytes (a scene is a few kilobytes of text); use at most {}",
                        name, text.size(), kMaxSceneBytes));
    std::size_t line = 1;
    for (std::size_t begin = 0; begin < text.size(); ++line)
    {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        const auto dots = std::count(text.begin() + static_cast<std::ptrdiff_t>(begin),
                                     text.begin() + static_cast<std::ptrdiff_t>(end), '.');
        if (dots > kMaxDotsPerLine)
            throw Error(
                fmt::format("{}:{}: the line holds {} dots (keys would nest too deep); use at most {}", name,
                            line, dots, kMaxDotsPerLine));
        begin = end + 1;
    }
}

}  // namespace

struct TomlDocument::Parsed
{
    std::string name;
    toml::table root;
};

TomlDocument::TomlDocument(std::string_view text, const std::string& name)
{
    check_text(text, name);
    try
    {
        parsed_ = std::make_unique<Parsed>(Parsed{name, toml::parse(text)});
    }
    catch (const toml::parse_error& error)
    {
        throw Error(fmt::format("{}:{}: is not TOML ({}); use the syntax of toml.io, version 1.0", name,
                                std::max<unsigned>(1, error.source().begin.line),
                                printable(error.description(), 200)));
    }
}

TomlDocument::~TomlDocument() = default;
TomlDocument::TomlDocument(TomlDocument&&) noexcept = default;

bool TomlDocument::empty() const
{
    return parsed_->root.empty();
}

void TomlDocument::set(std::string_view table, std::string_view key, const Value& value)
{
    toml::node* node = parsed_->root.get(table);
    if (!node) node = &parsed_->root.insert(table, toml::table{}).first->second;
    toml::table* inner = node->as_table();
    if (!inner) return;  // read() answers that it is no table
    std::visit([&](const auto& plain) { inner->insert_or_assign(key, plain); }, value);
}

void TomlDocument::require(bool ok, std::string_view table, std::string_view key, std::string_view why,
                           std::string_view allowed) const
{
    const toml::table* inner = parsed_->root[table].as_table();
    if (ok || !inner) return;
    Reader(Place{*inner, inner->source(), std::string(table), parsed_->name})
        .require(false, key, why, allowed);
}

void TomlDocument::read(const std::function<void(Section&)>& describe) const
{
    const Place root{parsed_->root, parsed_->root.source(), {}, parsed_->name};
    UnknownKeyFinder finder(root);
    describe(finder);
    finder.finish();
    Reader reader(root);
    describe(reader);
}

}  // namespace spindrift::scene
