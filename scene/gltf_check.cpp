// SPDX-License-Identifier: MIT
#include "scene/gltf_check.h"

#include <fmt/format.h>

#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

#include "core/error.h"

namespace spindrift::scene
{

namespace
{

using Json = nlohmann::json;

std::string read_whole(const std::filesystem::path& file)
{
    std::ifstream stream(file, std::ios::binary);
    std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
    if (!stream.is_open() || stream.bad())
        throw Error(fmt::format("{} cannot be opened for reading", file.string()));
    return bytes;
}

std::uint32_t word(std::string_view bytes, std::size_t at)
{
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, 4);
    return value;
}

/// One glTF document; every function throws Error for what it checks.
class Document
{
  public:
    explicit Document(const std::filesystem::path& file) : name_(file.string()), bytes_(read_whole(file))
    {
        const bool binary = bytes_.size() >= 4 && std::string_view(bytes_).substr(0, 4) == "glTF";
        const std::string_view text = binary ? json_chunk() : std::string_view(bytes_);
        json_ = Json::parse(text.begin(), text.end(), nullptr, false);
        if (json_.is_discarded()) fail("its JSON is broken or cut off");
        if (!json_.is_object()) fail("its JSON is not an object");
    }

    void check() const
    {
        if (depth_too_great(json_, 0)) fail("its JSON is nested more than 64 deep");
        check_buffers();
        check_views();
        check_accessors();
        check_meshes();
        check_nodes();
        check_materials_and_textures();
    }

    std::vector<float> emissive_strengths() const
    {
        std::vector<float> strengths;
        for (const Json& material : list("materials"))
        {
            double strength = 1;
            const Json& extension = member(member(material, "extensions"), "KHR_materials_emissive_strength");
            if (const Json& given = member(extension, "emissiveStrength"); given.is_number())
                strength = given.get<double>();
            if (!(strength >= 0 && strength <= 1e9)) fail("an emissiveStrength is not between 0 and 1e9");
            strengths.push_back(static_cast<float>(strength));
        }
        return strengths;
    }

  private:
    [[noreturn]] void fail(const std::string& reason) const
    {
        throw Error(fmt::format("{} is not a sound glTF file: {}", name_, reason));
    }

    static bool depth_too_great(const Json& value, int depth)
    {
        if (depth > 64) return true;
        if (value.is_structured())
            for (const Json& inner : value)
                if (depth_too_great(inner, depth + 1)) return true;
        return false;
    }

    std::string_view json_chunk()
    {
        const std::string_view bytes = bytes_;
        if (bytes.size() < 20) fail("it ends within its header");
        if (word(bytes, 4) != 2) fail(fmt::format("its version is {}, only 2 is known", word(bytes, 4)));
        if (word(bytes, 8) != bytes.size())
            fail(fmt::format("it says that it has {} bytes, but has {}", word(bytes, 8), bytes.size()));
        const std::size_t length = word(bytes, 12);
        if (word(bytes, 16) != 0x4E4F534AU) fail("its first chunk is not JSON");
        if (length > bytes.size() - 20) fail("its JSON chunk is longer than the file");
        const std::size_t next = 20 + length;
        if (next + 8 <= bytes.size())
        {
            if (next % 4 != 0) fail("its chunks are not aligned to 4 bytes");
            const std::size_t size = word(bytes, next);
            if (size > bytes.size() - next - 8) fail("its binary chunk is longer than the file");
            if (word(bytes, next + 4) == 0x004E4942U) binary_size_ = size;
        }
        return bytes.substr(20, length);
    }

    static const Json& member(const Json& object, const char* key)
    {
        static const Json nothing;
        if (!object.is_object()) return nothing;
        const auto found = object.find(key);
        return found == object.end() ? nothing : *found;
    }

    const Json& list(const char* key) const
    {
        static const Json empty = Json::array();
        const Json& value = member(json_, key);
        if (value.is_null()) return empty;
        if (!value.is_array()) fail(fmt::format("'{}' is not a list", key));
        for (const Json& entry : value)
            if (!entry.is_object()) fail(fmt::format("an entry of '{}' is not an object", key));
        return value;
    }

    /// A whole number, 0 or more; `otherwise` if it is missing.
    std::uint64_t whole(const Json& object, const char* key, std::uint64_t otherwise) const
    {
        const Json& value = member(object, key);
        if (value.is_null()) return otherwise;
        if (!value.is_number_unsigned() || value.get<std::uint64_t>() > 0x7FFFFFFFULL)
            fail(fmt::format("'{}' is not a whole number between 0 and 2147483647", key));
        return value.get<std::uint64_t>();
    }

    static constexpr std::uint64_t kMissing = ~std::uint64_t{0};

    /// An index into the list `of`; kMissing if it is not there.
    std::uint64_t index(const Json& object, const char* key, const char* of) const
    {
        const std::uint64_t value = whole(object, key, kMissing);
        if (value != kMissing && value >= list(of).size())
            fail(fmt::format("'{}' is {}, but there are {} {}", key, value, list(of).size(), of));
        return value;
    }

    void check_buffers() const
    {
        for (const Json& buffer : list("buffers"))
        {
            const std::uint64_t length = whole(buffer, "byteLength", kMissing);
            if (length == kMissing || length == 0) fail("a buffer has no byteLength");
            const Json& uri = member(buffer, "uri");
            if (uri.is_null())
            {
                if (length > binary_size_ + 3)
                    fail(fmt::format("a buffer of {} bytes has no uri and no such binary chunk", length));
                continue;
            }
            if (!uri.is_string()) fail("the uri of a buffer is not a text");
            check_embedded(uri.get_ref<const std::string&>(), length);
        }
    }

    void check_embedded(const std::string& uri, std::uint64_t length) const
    {
        if (uri.rfind("data:", 0) != 0) return check_external(uri, length);
        const std::size_t comma = uri.find(',');
        if (comma == std::string::npos) fail("the data of a buffer is cut off");
        if (uri.find(";base64") >= comma) fail("the data of a buffer is not in base64");
        const std::string_view text = std::string_view(uri).substr(comma + 1);
        const std::size_t padding =
            text.find_first_not_of("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/");
        const std::size_t digits = padding == std::string_view::npos ? text.size() : padding;
        if (text.find_first_not_of('=', digits) != std::string_view::npos)
            fail("the base64 data of a buffer holds a strange character");
        if (text.size() % 4 != 0 || text.size() - digits > 2) fail("the base64 data of a buffer is cut off");
        if (digits * 3 / 4 < length)
            fail(fmt::format("a buffer says {} bytes, but holds {}", length, digits * 3 / 4));
    }

    void check_external(const std::string& uri, std::uint64_t length) const
    {
        const std::filesystem::path path = std::filesystem::path(name_).parent_path() / uri;
        std::error_code failed;
        const auto size = std::filesystem::file_size(path, failed);
        if (failed) fail(fmt::format("its buffer '{}' cannot be read ({})", uri, failed.message()));
        if (size < length) fail(fmt::format("its buffer '{}' has {} bytes, not {}", uri, size, length));
    }

    void check_views() const
    {
        for (const Json& view : list("bufferViews"))
        {
            const std::uint64_t buffer = index(view, "buffer", "buffers");
            if (buffer == kMissing) fail("a bufferView has no buffer");
            const std::uint64_t offset = whole(view, "byteOffset", 0), length = whole(view, "byteLength", 0);
            if (offset + length > whole(list("buffers")[buffer], "byteLength", 0))
                fail("a bufferView reaches out of its buffer");
            if (const std::uint64_t stride = whole(view, "byteStride", 4); stride < 4 || stride > 252)
                fail(fmt::format("a byteStride of {} is not between 4 and 252", stride));
        }
    }

    static std::uint64_t component_bytes(std::uint64_t type)
    {
        switch (type)
        {
            case 5120:
            case 5121:
                return 1;
            case 5122:
            case 5123:
                return 2;
            case 5125:
            case 5126:
                return 4;
            default:
                return 0;
        }
    }

    static std::uint64_t components(const std::string& type)
    {
        static const std::pair<const char*, std::uint64_t> known[] = {
            {"SCALAR", 1}, {"VEC2", 2}, {"VEC3", 3}, {"VEC4", 4}, {"MAT2", 4}, {"MAT3", 9}, {"MAT4", 16}};
        for (const auto& [name, count] : known)
            if (type == name) return count;
        return 0;
    }

    void check_accessors() const
    {
        for (const Json& accessor : list("accessors"))
        {
            const Json& type = member(accessor, "type");
            if (!type.is_string() || components(type.get<std::string>()) == 0)
                fail("an accessor has no known type");
            const std::uint64_t bytes = component_bytes(whole(accessor, "componentType", 0));
            if (bytes == 0) fail("an accessor has no known componentType");
            const std::uint64_t count = whole(accessor, "count", 0);
            if (count == 0) fail("an accessor counts nothing");
            if (!member(accessor, "sparse").is_null()) fail("it has sparse accessors, which are not read");
            const std::uint64_t view = index(accessor, "bufferView", "bufferViews");
            if (view == kMissing) fail("an accessor has no bufferView");
            const Json& in = list("bufferViews")[view];
            const std::uint64_t element = bytes * components(type.get<std::string>());
            const std::uint64_t stride = whole(in, "byteStride", element),
                                offset = whole(accessor, "byteOffset", 0);
            if (stride < element || offset + stride * (count - 1) + element > whole(in, "byteLength", 0))
                fail("an accessor reaches out of its bufferView");
        }
    }

    /// The accessor under `key` must hold `type`; returns its count, 0 if there is none.
    std::uint64_t require(const Json& object, const char* key, const char* type) const
    {
        const std::uint64_t at = index(object, key, "accessors");
        if (at == kMissing) return 0;
        const Json& accessor = list("accessors")[at];
        if (member(accessor, "type") != type) fail(fmt::format("'{}' is not a {}", key, type));
        return whole(accessor, "count", 0);
    }

    void check_meshes() const
    {
        for (const Json& mesh : list("meshes"))
        {
            const Json& primitives = member(mesh, "primitives");
            if (!primitives.is_array()) fail("a mesh has no primitives");
            for (const Json& primitive : primitives) check_primitive(primitive);
        }
    }

    void check_primitive(const Json& primitive) const
    {
        if (!primitive.is_object()) fail("a primitive is not an object");
        const Json& attributes = member(primitive, "attributes");
        if (!attributes.is_object()) fail("a primitive has no attributes");
        const std::uint64_t vertices = require(attributes, "POSITION", "VEC3");
        if (vertices == 0) fail("a primitive has no POSITION");
        for (const auto& [name, accessor] : attributes.items())
        {
            const std::uint64_t at = index(attributes, name.c_str(), "accessors");
            if (whole(list("accessors")[at], "count", 0) != vertices)
                fail(fmt::format("{} and POSITION differ in their count", name));
            if (name == "POSITION" || name == "NORMAL")
                if (whole(list("accessors")[at], "componentType", 0) != 5126)
                    fail(fmt::format("{} is not in floats", name));
        }
        require(attributes, "NORMAL", "VEC3");
        require(primitive, "indices", "SCALAR");
        if (whole(primitive, "mode", 4) > 6) fail("a primitive has no known mode");
        index(primitive, "material", "materials");
        if (const Json& targets = member(primitive, "targets"); !targets.is_null())
        {
            if (!targets.is_array()) fail("the morph targets of a primitive are not a list");
            for (const Json& target : targets)
            {
                if (!target.is_object()) fail("a morph target is not an object");
                for (const auto& [name, accessor] : target.items())
                    if (require(target, name.c_str(), "VEC3") != vertices)
                        fail("a morph target has another count");
            }
        }
    }

    void check_nodes() const
    {
        const Json& nodes = list("nodes");
        const Json& lights = member(member(member(json_, "extensions"), "KHR_lights_punctual"), "lights");
        std::vector<int> parents(nodes.size(), 0);
        for (const Json& node : nodes)
        {
            index(node, "mesh", "meshes");
            index(node, "camera", "cameras");
            index(node, "skin", "skins");
            check_numbers(node, "matrix", 16);
            check_numbers(node, "translation", 3);
            check_numbers(node, "rotation", 4);
            check_numbers(node, "scale", 3);
            const std::uint64_t light =
                whole(member(member(node, "extensions"), "KHR_lights_punctual"), "light", kMissing);
            if (light != kMissing && (!lights.is_array() || light >= lights.size()))
                fail("a node names a light that is not there");
            each_index(node, "children", nodes.size(), [&](std::uint64_t child) { ++parents[child]; });
        }
        for (const int count : parents)
            if (count > 1) fail("a node has two parents");
        check_loops(nodes, parents);
        for (const Json& scene : list("scenes"))
            each_index(scene, "nodes", nodes.size(), [](std::uint64_t) {});
        index(json_, "scene", "scenes");
    }

    /// With at most one parent each, every node that is not below a root is in a loop.
    void check_loops(const Json& nodes, const std::vector<int>& parents) const
    {
        std::vector<std::pair<std::uint64_t, int>> open;
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] == 0) open.emplace_back(i, 0);
        std::size_t reached = 0;
        while (!open.empty())
        {
            const auto [node, depth] = open.back();
            open.pop_back();
            ++reached;
            if (depth > 512) fail("its nodes are nested more than 512 deep");
            each_index(nodes[node], "children", nodes.size(),
                       [&](std::uint64_t child) { open.emplace_back(child, depth + 1); });
        }
        if (reached != nodes.size()) fail("a node lies below itself");
    }

    template <class Visit>
    void each_index(const Json& object, const char* key, std::size_t limit, Visit visit) const
    {
        const Json& values = member(object, key);
        if (values.is_null()) return;
        if (!values.is_array()) fail(fmt::format("'{}' is not a list", key));
        for (const Json& value : values)
        {
            if (!value.is_number_unsigned() || value.get<std::uint64_t>() >= limit)
                fail(fmt::format("'{}' names something that is not there", key));
            visit(value.get<std::uint64_t>());
        }
    }

    void check_numbers(const Json& object, const char* key, std::size_t count) const
    {
        const Json& values = member(object, key);
        if (values.is_null()) return;
        if (!values.is_array() || values.size() != count)
            fail(fmt::format("'{}' is not a list of {} numbers", key, count));
        for (const Json& value : values)
            if (!value.is_number() || !(std::abs(value.get<double>()) < 1e30))
                fail(fmt::format("'{}' holds no sound numbers", key));
    }

    void check_materials_and_textures() const
    {
        for (const Json& texture : list("textures"))
        {
            index(texture, "source", "images");
            index(texture, "sampler", "samplers");
        }
        for (const Json& image : list("images")) index(image, "bufferView", "bufferViews");
        for (const Json& material : list("materials")) check_texture_uses(material);
    }

    /// Wherever a material says "…Texture": {"index": n}.
    void check_texture_uses(const Json& value) const
    {
        if (value.is_array())
            for (const Json& inner : value) check_texture_uses(inner);
        if (!value.is_object()) return;
        for (const auto& [key, inner] : value.items())
        {
            if (key.size() >= 7 && key.compare(key.size() - 7, 7, "Texture") == 0)
                index(inner, "index", "textures");
            check_texture_uses(inner);
        }
    }

    std::string name_;
    std::string bytes_;
    Json json_;
    std::uint64_t binary_size_ = 0;
};

}  // namespace

std::vector<float> check_gltf(const std::filesystem::path& file)
{
    std::string extension = file.extension().string();
    for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (extension != ".gltf" && extension != ".glb") return {};
    const Document document(file);
    document.check();
    return document.emissive_strengths();
}

}  // namespace spindrift::scene
