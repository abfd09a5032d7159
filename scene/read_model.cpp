// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <assimp/DefaultIOSystem.h>
#include <assimp/GltfMaterial.h>
#include <assimp/material.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <map>

#include "core/error.h"
#include "scene/gltf_check.h"
#include "scene/mesh.h"
#include "scene/placement.h"
#include "scene/try_in_child.h"

namespace spindrift::scene
{

namespace
{

/// A model wider than this is a mistake of scale (float positions resolve 6 cm there).
constexpr double kLargestModel_m = 1e6;
constexpr std::size_t kMostVertices = std::size_t{1} << 26;
constexpr std::uintmax_t kLargestFile = std::uintmax_t{2} << 30;
constexpr unsigned kLongestRead_s = 600;

/// Lets a model file open only plain files in its own folder and below: a buffer's name may say anything.
class FolderOnly final : public Assimp::DefaultIOSystem
{
  public:
    explicit FolderOnly(const std::filesystem::path& folder)
        : folder_(std::filesystem::weakly_canonical(folder))
    {
    }

    bool Exists(const char* name) const override { return allowed(name); }

    Assimp::IOStream* Open(const char* name, const char* mode) override
    {
        return allowed(name) && mode[0] == 'r' ? DefaultIOSystem::Open(name, mode) : nullptr;
    }

  private:
    bool allowed(const char* name) const
    {
        std::error_code failed;
        const auto path = std::filesystem::weakly_canonical(name, failed);
        if (failed || !std::filesystem::is_regular_file(path, failed)) return false;
        return std::mismatch(folder_.begin(), folder_.end(), path.begin(), path.end()).first == folder_.end();
    }

    std::filesystem::path folder_;
};

std::filesystem::path absolute_file(const Scene& scene, const ModelSettings& settings)
{
    const auto& file = settings.file;
    return file.is_absolute() ? file : scene.file.parent_path() / file;
}

void check_file(const std::filesystem::path& file)
{
    std::error_code failed;
    const auto status = std::filesystem::status(file, failed);
    if (!std::filesystem::exists(status)) throw Error(fmt::format("{}: no such model file", file.string()));
    if (std::filesystem::is_directory(status))
        throw Error(fmt::format("{} is a directory; name a model file in it", file.string()));
    if (!std::filesystem::is_regular_file(status))
        throw Error(fmt::format("{} is not a plain file", file.string()));
    const auto size = std::filesystem::file_size(file, failed);
    if (failed) throw Error(fmt::format("{}: {}", file.string(), failed.message()));
    if (size == 0) throw Error(fmt::format("{} is empty", file.string()));
    if (size > kLargestFile)
        throw Error(
            fmt::format("{} has {} bytes; models of at most {} are read", file.string(), size, kLargestFile));
}

/// What no later step may meet: vertices that are not finite, and faces that point outside of their mesh.
void check_meshes(const aiScene& model, const std::string& file)
{
    for (unsigned m = 0; m < model.mNumMeshes; ++m)
    {
        const aiMesh& mesh = *model.mMeshes[m];
        if (mesh.mNumVertices > 0 && mesh.mVertices == nullptr)
            throw Error(fmt::format("{}: mesh {} has no positions", file, m));
        for (unsigned i = 0; i < mesh.mNumVertices; ++i)
        {
            const aiVector3D& v = mesh.mVertices[i];
            if (!std::isfinite(v.x) || !std::isfinite(v.y) || !std::isfinite(v.z))
                throw Error(fmt::format(
                    "{}: vertex {} of mesh {} ('{}') is not finite ({}, {}, {}); repair the model", file, i,
                    m, mesh.mName.C_Str(), v.x, v.y, v.z));
        }
        for (unsigned f = 0; f < mesh.mNumFaces; ++f)
            for (unsigned k = 0; k < mesh.mFaces[f].mNumIndices; ++k)
                if (mesh.mFaces[f].mIndices[k] >= mesh.mNumVertices)
                    throw Error(fmt::format("{}: face {} of mesh {} uses vertex {}, but there are {}", file,
                                            f, m, mesh.mFaces[f].mIndices[k], mesh.mNumVertices));
    }
}

/// Reads and post-processes; the importer owns the result.
const aiScene& import(Assimp::Importer& importer, const std::filesystem::path& file)
{
    const std::string name = file.string();
    try
    {
        importer.SetIOHandler(
            new FolderOnly(std::filesystem::absolute(file).parent_path()));  // the importer deletes it
        importer.SetPropertyInteger(AI_CONFIG_PP_SBP_REMOVE, aiPrimitiveType_POINT | aiPrimitiveType_LINE);
        const aiScene* raw = importer.ReadFile(name, 0);
        if (raw == nullptr || raw->mRootNode == nullptr)
            throw Error(fmt::format("{} cannot be read as a model: {}", name, importer.GetErrorString()));
        check_meshes(*raw, name);
        const aiScene* model =
            importer.ApplyPostProcessing(aiProcess_ValidateDataStructure | aiProcess_Triangulate |
                                         aiProcess_SortByPType | aiProcess_GenNormals);
        if (model == nullptr)
            throw Error(fmt::format("{} cannot be read as a model: {}", name, importer.GetErrorString()));
        check_meshes(*model, name);
        return *model;
    }
    catch (const Error&)
    {
        throw;
    }
    catch (const std::exception& problem)
    {
        throw Error(fmt::format("{} cannot be read as a model: {}", name, problem.what()));
    }
}

Colour colour_of(const aiColor3D& c)
{
    const auto part = [](float v) { return std::isfinite(v) && v > 0 ? v : 0.0F; };
    return {part(c.r), part(c.g), part(c.b)};
}

float share(float value, float otherwise)
{
    return std::isfinite(value) ? std::clamp(value, 0.0F, 1.0F) : otherwise;
}

Material material_of(const aiMaterial& given, float emissive_strength)
{
    Material material;
    aiColor4D base;
    aiColor3D colour;
    if (given.Get(AI_MATKEY_BASE_COLOR, base) == aiReturn_SUCCESS)
        material.albedo = colour_of({base.r, base.g, base.b});
    else if (given.Get(AI_MATKEY_COLOR_DIFFUSE, colour) == aiReturn_SUCCESS)
        material.albedo = colour_of(colour);
    if (given.Get(AI_MATKEY_COLOR_EMISSIVE, colour) == aiReturn_SUCCESS)
    {
        float strength = 1;
        if (given.Get(AI_MATKEY_EMISSIVE_INTENSITY, strength) != aiReturn_SUCCESS || !std::isfinite(strength))
            strength = 1;
        material.emission = colour_of(colour * (strength * emissive_strength));
    }
    float value = 0;
    if (given.Get(AI_MATKEY_ROUGHNESS_FACTOR, value) == aiReturn_SUCCESS)
        material.roughness = share(value, 1);
    else if (given.Get(AI_MATKEY_SHININESS, value) == aiReturn_SUCCESS && value > 0)
        material.roughness =
            share(std::sqrt(2 / (value + 2)), 1);  // Blinn-Phong exponent to GGX roughness (Karis 2013)
    if (given.Get(AI_MATKEY_METALLIC_FACTOR, value) == aiReturn_SUCCESS) material.metallic = share(value, 0);
    return material;
}

struct Affine
{
    double m[3][4];

    explicit Affine(const aiMatrix4x4t<double>& a)
        : m{{a.a1, a.a2, a.a3, a.a4}, {a.b1, a.b2, a.b3, a.b4}, {a.c1, a.c2, a.c3, a.c4}}
    {
    }
    Vec3d direction(const Vec3d& v) const
    {
        return {m[0][0] * v.x + m[0][1] * v.y + m[0][2] * v.z, m[1][0] * v.x + m[1][1] * v.y + m[1][2] * v.z,
                m[2][0] * v.x + m[2][1] * v.y + m[2][2] * v.z};
    }
    Vec3d point(const Vec3d& p) const { return direction(p) + Vec3d{m[0][3], m[1][3], m[2][3]}; }

    /// The inverse transposed, up to a positive factor: how normals turn.
    Vec3d normal(const Vec3d& n) const
    {
        const auto cofactor = [&](int r, int c)
        {
            const int r1 = (r + 1) % 3, r2 = (r + 2) % 3, c1 = (c + 1) % 3, c2 = (c + 2) % 3;
            return m[r1][c1] * m[r2][c2] - m[r1][c2] * m[r2][c1];
        };
        const double sign = mirrors() ? -1 : 1;
        return Vec3d{cofactor(0, 0) * n.x + cofactor(0, 1) * n.y + cofactor(0, 2) * n.z,
                     cofactor(1, 0) * n.x + cofactor(1, 1) * n.y + cofactor(1, 2) * n.z,
                     cofactor(2, 0) * n.x + cofactor(2, 1) * n.y + cofactor(2, 2) * n.z} *
               sign;
    }
    bool mirrors() const
    {
        return dot(cross(Vec3d{m[0][0], m[1][0], m[2][0]}, Vec3d{m[0][1], m[1][1], m[2][1]}),
                   Vec3d{m[0][2], m[1][2], m[2][2]}) < 0;
    }
};

Vec3d unit_or(const Vec3d& v, const Vec3d& otherwise)
{
    const double length = std::sqrt(dot(v, v));
    return std::isfinite(length) && length > 1e-30 ? v * (1 / length) : otherwise;
}

Vec3d vec(const aiVector3D& v)
{
    return {v.x, v.y, v.z};
}

Vec3f narrow(const Vec3d& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

/// Walks the nodes of a model and gathers its meshes and lights in the frame of the scene.
class Gatherer
{
  public:
    Gatherer(const aiScene& model, const Scene& scene, const ModelSettings& settings, std::string file)
        : model_(model), settings_(settings), placement_(settings), file_(std::move(file))
    {
        if (settings.vehicle.empty()) origin_ = scene.domain.min_m;
        for (unsigned i = 0; i < model.mNumLights; ++i) light_of_[model.mLights[i]->mName.C_Str()] = i;
    }

    void gather(Mesh& mesh, std::vector<Light>& lights)
    {
        mesh_ = &mesh;
        lights_ = &lights;
        visit(*model_.mRootNode, aiMatrix4x4t<double>());
    }

  private:
    void visit(const aiNode& node, const aiMatrix4x4t<double>& parent)
    {
        const aiMatrix4x4t<double> matrix = parent * aiMatrix4x4t<double>(node.mTransformation);
        const Affine transform(matrix);
        for (unsigned i = 0; i < node.mNumMeshes; ++i) add_mesh(*model_.mMeshes[node.mMeshes[i]], transform);
        if (const auto light = light_of_.find(node.mName.C_Str()); light != light_of_.end())
            add_light(*model_.mLights[light->second], node, transform);
        for (unsigned i = 0; i < node.mNumChildren; ++i) visit(*node.mChildren[i], matrix);
    }

    void add_mesh(const aiMesh& from, const Affine& transform)
    {
        if ((from.mPrimitiveTypes & aiPrimitiveType_TRIANGLE) == 0) return;
        if (mesh_->vertices.size() + from.mNumVertices > kMostVertices)
            throw Error(
                fmt::format("{} has more than {} vertices (instances counted)", file_, kMostVertices));
        const auto first = static_cast<std::uint32_t>(mesh_->vertices.size());
        for (unsigned i = 0; i < from.mNumVertices; ++i)
        {
            const Vec3d p = placement_.point(transform.point(vec(from.mVertices[i])));
            if (!(std::abs(p.x) < kLargestModel_m && std::abs(p.y) < kLargestModel_m &&
                  std::abs(p.z) < kLargestModel_m))
                throw Error(fmt::format(
                    "{}: vertex {} of mesh '{}' comes to lie at ({:g}, {:g}, {:g}) m, more than {:g} m away; "
                    "check scale and position_m",
                    file_, i, from.mName.C_Str(), p.x, p.y, p.z, kLargestModel_m));
            const Vec3d n = from.mNormals != nullptr
                                ? placement_.direction(transform.normal(vec(from.mNormals[i])))
                                : Vec3d{0, 0, 0};
            mesh_->vertices.push_back({narrow(p - origin_), narrow(unit_or(n, {0, 0, 1}))});
        }
        MeshPart& part = part_of(static_cast<int>(from.mMaterialIndex));
        const bool mirrored = transform.mirrors();
        for (unsigned f = 0; f < from.mNumFaces; ++f)
        {
            const aiFace& face = from.mFaces[f];
            if (face.mNumIndices != 3) continue;
            const unsigned a = mirrored ? 2 : 0, c = mirrored ? 0 : 2;
            part.indices.insert(part.indices.end(), {first + face.mIndices[a], first + face.mIndices[1],
                                                     first + face.mIndices[c]});
        }
    }

    MeshPart& part_of(int material)
    {
        for (MeshPart& part : mesh_->parts)
            if (part.material == material) return part;
        return mesh_->parts.emplace_back(MeshPart{material, {}});
    }

    void add_light(const aiLight& from, const aiNode& node, const Affine& transform)
    {
        Light light;
        switch (from.mType)
        {
            case aiLightSource_POINT:
                light.kind = LightKind::point;
                break;
            case aiLightSource_SPOT:
                light.kind = LightKind::spot;
                break;
            case aiLightSource_DIRECTIONAL:
                light.kind = LightKind::directional;
                break;
            default:
                return;  // ambient and area lights have no counterpart
        }
        light.name = settings_.file.stem().string() + ":" + from.mName.C_Str();
        light.position_m = placement_.point(transform.point(vec(from.mPosition)));
        light.direction =
            unit_or(placement_.direction(transform.direction(vec(from.mDirection))), {0, 0, -1});
        light.intensity = colour_of(from.mColorDiffuse);
        float range = 0;
        if (node.mMetaData != nullptr && node.mMetaData->Get("PBR_LightRange", range) &&
            std::isfinite(range) && range > 0)
            light.range_m = static_cast<double>(range);
        if (light.kind == LightKind::spot) set_cone(light, from);
        light.vehicle = settings_.vehicle;
        const auto& p = light.position_m;
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z))
            throw Error(fmt::format("{}: the place of light '{}' is not finite", file_, from.mName.C_Str()));
        lights_->push_back(light);
    }

    /// assimp passes the half angles of glTF on as they are; those of other formats are full angles, as its
    /// aiLight says.
    void set_cone(Light& light, const aiLight& from) const
    {
        const std::string extension = settings_.file.extension().string();
        const double half = extension == ".gltf" || extension == ".glb" ? 1.0 : 0.5;
        const auto degrees = [&](float angle, double otherwise)
        {
            const double d = half * static_cast<double>(angle) * (180.0 / 3.14159265358979323846);
            return std::isfinite(d) && d >= 0 ? std::min(d, 90.0) : otherwise;
        };
        light.outer_cone_deg = std::max(degrees(from.mAngleOuterCone, light.outer_cone_deg), 0.1);
        light.inner_cone_deg =
            std::min(degrees(from.mAngleInnerCone, light.inner_cone_deg), light.outer_cone_deg);
    }

    const aiScene& model_;
    const ModelSettings& settings_;
    Placement placement_;
    std::string file_;
    Vec3d origin_{};
    std::map<std::string, unsigned> light_of_;
    Mesh* mesh_ = nullptr;
    std::vector<Light>* lights_ = nullptr;
};

}  // namespace

Mesh read_model(const Scene& scene, const ModelSettings& settings, std::vector<Light>& lights)
{
    const std::filesystem::path file = absolute_file(scene, settings);
    check_file(file);
    const std::vector<float> strengths = check_gltf(file);
    const auto try_import = [&]
    {
        Assimp::Importer tried;
        import(tried, file);
    };
    if (try_in_child(try_import, kLongestRead_s) != ChildFate::returned)
        throw Error(
            fmt::format("{} cannot be read as a model: broken so that the reader of its format fails on it",
                        file.string()));
    Assimp::Importer importer;
    const aiScene& model = import(importer, file);

    Mesh mesh;
    mesh.surface = settings.surface;
    mesh.solid = settings.solid && settings.vehicle.empty();
    mesh.vehicle = settings.vehicle;
    for (unsigned i = 0; i < model.mNumMaterials; ++i)
        mesh.materials.push_back(
            material_of(*model.mMaterials[i], i < strengths.size() ? strengths[i] : 1.0F));
    if (mesh.materials.empty()) mesh.materials.emplace_back();
    std::vector<Light> found;
    Gatherer(model, scene, settings, file.string()).gather(mesh, found);

    std::erase_if(mesh.parts, [](const MeshPart& part) { return part.indices.empty(); });
    if (mesh.parts.empty())
        throw Error(fmt::format("{} holds no triangles; nothing of it could be drawn or met", file.string()));
    for (MeshPart& part : mesh.parts)
        if (part.material < 0 || part.material >= static_cast<int>(mesh.materials.size())) part.material = 0;
    lights.insert(lights.end(), found.begin(), found.end());
    return mesh;
}

}  // namespace spindrift::scene
