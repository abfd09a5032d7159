// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>

#include "core/error.h"
#include "core/philox.h"
#include "scene/mesh.h"
#include "tests/scene/temporary_folder.h"

namespace spindrift::scene
{
namespace
{

using ::testing::HasSubstr;

const std::filesystem::path kModels = std::filesystem::path(SPINDRIFT_SOURCE_DIR) / "scenes" / "models";

/// A triangle with its normals, as one OBJ file.
constexpr std::string_view kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

ModelSettings settings_of(const std::filesystem::path& file)
{
    ModelSettings settings;
    settings.file = file;
    return settings;
}

Mesh read(const ModelSettings& settings, std::vector<Light>* lights = nullptr)
{
    Scene scene;
    std::vector<Light> unused;
    return read_model(scene, settings, lights != nullptr ? *lights : unused);
}

std::string error_of(const std::filesystem::path& file)
{
    try
    {
        read(settings_of(file));
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "";
}

std::size_t triangles(const Mesh& mesh)
{
    std::size_t n = 0;
    for (const MeshPart& part : mesh.parts) n += part.indices.size() / 3;
    return n;
}

/// Six times the volume that the triangles enclose; positive if their fronts face outwards.
double signed_volume(const Mesh& mesh)
{
    double sum = 0;
    for (const MeshPart& part : mesh.parts)
        for (std::size_t i = 0; i < part.indices.size(); i += 3)
        {
            const Vec3f &a = mesh.vertices[part.indices[i]].position_m,
                        &b = mesh.vertices[part.indices[i + 1]].position_m,
                        &c = mesh.vertices[part.indices[i + 2]].position_m;
            sum += dot(a, cross(b, c));
        }
    return sum;
}

TEST(ReadModel, TownIsYUpAndHasItsMaterials)
{
    const Mesh mesh = read(settings_of(kModels / "town.obj"));
    EXPECT_GT(triangles(mesh), 2000U);
    Vec3f low{1e9F, 1e9F, 1e9F}, high{-1e9F, -1e9F, -1e9F};
    for (const Vertex& v : mesh.vertices)
    {
        low = {std::min(low.x, v.position_m.x), std::min(low.y, v.position_m.y),
               std::min(low.z, v.position_m.z)};
        high = {std::max(high.x, v.position_m.x), std::max(high.y, v.position_m.y),
                std::max(high.z, v.position_m.z)};
        ASSERT_NEAR(dot(v.normal, v.normal), 1, 1e-4);
    }
    EXPECT_FLOAT_EQ(low.z, 0);
    EXPECT_FLOAT_EQ(high.z, 38);
    EXPECT_GE(low.x, 0);
    EXPECT_LE(high.y, 160);
    EXPECT_GT(high.y, 140);
    EXPECT_GT(std::count_if(mesh.materials.begin(), mesh.materials.end(),
                            [](const Material& m) { return m.emission.r > 0; }),
              1);
}

TEST(ReadModel, MakesNormalsThatPointOutOfTheFrontFace)
{
    const TemporaryFolder folder;
    ModelSettings settings = settings_of(folder.write("t.obj", kTriangle));
    settings.y_up = false;
    const Mesh mesh = read(settings);
    ASSERT_EQ(triangles(mesh), 1U);
    for (const Vertex& v : mesh.vertices) EXPECT_NEAR(v.normal.z, 1, 1e-6);
}

TEST(ReadModel, PlacesScalesAndTurns)
{
    const TemporaryFolder folder;
    ModelSettings settings = settings_of(folder.write("t.obj", "v 1 0 0\nv 2 0 0\nv 1 1 0\nf 1 2 3\n"));
    settings.scale = 2;
    settings.yaw_deg = 90;
    settings.position_m = {10, 20, 30};
    Scene scene;
    scene.domain.min_m = {1, 2, 3};
    std::vector<Light> lights;
    const Mesh mesh = read_model(scene, settings, lights);
    // (1, 0, 0) -> scaled (2, 0, 0) -> a quarter turn (0, 2, 0) -> place - corner
    EXPECT_NEAR(mesh.vertices[mesh.parts[0].indices[0]].position_m.x, 9, 1e-5);
    EXPECT_NEAR(mesh.vertices[mesh.parts[0].indices[0]].position_m.y, 20, 1e-5);
    EXPECT_NEAR(mesh.vertices[mesh.parts[0].indices[0]].position_m.z, 27, 1e-5);
    // (1, 1, 0): the file's y is up
    EXPECT_NEAR(mesh.vertices[mesh.parts[0].indices[2]].position_m.z, 29, 1e-5);
}

TEST(ReadModel, ReadsTheLampWithItsLightAndItsEmission)
{
    ModelSettings settings = settings_of(kModels / "lamp.gltf");
    settings.position_m = {100, 50, 1};
    settings.yaw_deg = 180;
    std::vector<Light> lights;
    const Mesh mesh = read(settings, &lights);
    EXPECT_GT(signed_volume(mesh), 0) << "faces show their fronts outwards";
    ASSERT_EQ(lights.size(), 1U);
    const Light& light = lights[0];
    EXPECT_EQ(light.kind, LightKind::spot);
    EXPECT_NEAR(light.position_m.x, 100 - 1.6, 1e-5);
    EXPECT_NEAR(light.position_m.y, 50, 1e-5);
    EXPECT_NEAR(light.position_m.z, 6.8, 1e-5);
    EXPECT_NEAR(light.direction.z, -1, 1e-5) << "shines down";
    EXPECT_NEAR(light.intensity.r, 120, 1e-3);
    EXPECT_NEAR(light.intensity.b, 120 * 0.13, 1e-3);
    EXPECT_NEAR(light.range_m, 60, 1e-3);
    EXPECT_NEAR(light.outer_cone_deg, 1.2 * 180 / 3.14159265, 1e-3);
    EXPECT_NEAR(light.inner_cone_deg, 0.7 * 180 / 3.14159265, 1e-3);
    float brightest = 0;
    for (const Material& m : mesh.materials) brightest = std::max(brightest, m.emission.r);
    EXPECT_NEAR(brightest, 9, 1e-4) << "emissive strength counts";
    EXPECT_NEAR(mesh.materials[0].roughness, 0.8, 1e-6);
    EXPECT_EQ(mesh.materials[0].metallic, 0);
}

TEST(ReadModel, VehicleModelsStayInTheVehiclesFrameAndAreNeverSolid)
{
    const TemporaryFolder folder;
    ModelSettings settings = settings_of(folder.write("t.obj", kTriangle));
    settings.vehicle = "plough";
    Scene scene;
    scene.domain.min_m = {100, 100, 100};
    std::vector<Light> lights;
    const Mesh mesh = read_model(scene, settings, lights);
    EXPECT_FALSE(mesh.solid);
    EXPECT_EQ(mesh.vehicle, "plough");
    EXPECT_NEAR(mesh.vertices[mesh.parts[0].indices[0]].position_m.x, 0, 1e-6);
}

TEST(ReadModel, TriangulatesPolygonsAndDropsLines)
{
    const TemporaryFolder folder;
    const Mesh mesh = read(settings_of(
        folder.write("t.obj", "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nf 1 2 3 4 5\nl 1 3\n")));
    EXPECT_EQ(triangles(mesh), 3U);
}

TEST(ReadModel, SaysWhatIsWrongWithAFile)
{
    const TemporaryFolder folder;
    EXPECT_THAT(error_of(folder / "none.obj"), HasSubstr("no such model"));
    EXPECT_THAT(error_of(folder.path()), HasSubstr("is a directory"));
    EXPECT_THAT(error_of(folder.write("empty.obj", "")), HasSubstr("empty"));
    EXPECT_NE(error_of(folder.write("points.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\n")), "");
    EXPECT_NE(error_of(folder.write("what.xyz", "hello")), "");
    EXPECT_NE(error_of(folder.write("noise.obj", std::string(1000, '\x81'))), "");
    EXPECT_THAT(error_of("/dev/zero"), HasSubstr("not a plain file"));
}

TEST(ReadModel, RefusesVerticesThatAreNotFinite)
{
    const TemporaryFolder folder;
    EXPECT_THAT(error_of(folder.write("nan.obj", "v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n")),
                HasSubstr("not finite"));
    EXPECT_THAT(error_of(folder.write("inf.obj", "v 0 0 0\nv inf 0 0\nv 0 1 0\nf 1 2 3\n")),
                HasSubstr("not finite"));
    EXPECT_THAT(error_of(folder.write("far.obj", "v 0 0 0\nv 1e9 0 0\nv 0 1 0\nf 1 2 3\n")),
                HasSubstr("check scale"));
}

TEST(ReadModel, RefusesIndicesOutOfRange)
{
    const TemporaryFolder folder;
    EXPECT_NE(error_of(folder.write("index.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n")), "");
}

/// The lamp as .glb: the JSON chunk and its buffer as a binary chunk.
std::string glb()
{
    std::string json =
        R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"scale":[2,2,2]}],)"
        R"("meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}],)"
        R"("accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},)"
        R"({"bufferView":1,"componentType":5125,"count":3,"type":"SCALAR"}],)"
        R"("bufferViews":[{"buffer":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":12}],)"
        R"("buffers":[{"byteLength":48}]})";
    while (json.size() % 4 != 0) json += ' ';
    const float positions[9] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::uint32_t indices[3] = {0, 1, 2};
    std::string out;
    const auto word = [&](std::uint32_t v) { out.append(reinterpret_cast<const char*>(&v), 4); };
    word(0x46546C67U), word(2), word(static_cast<std::uint32_t>(12 + 8 + json.size() + 8 + 48));
    word(static_cast<std::uint32_t>(json.size())), word(0x4E4F534AU);
    out += json;
    word(48), word(0x004E4942U);
    out.append(reinterpret_cast<const char*>(positions), 36);
    out.append(reinterpret_cast<const char*>(indices), 12);
    return out;
}

TEST(ReadModel, ReadsBinaryGltfWithNodeTransforms)
{
    const TemporaryFolder folder;
    const Mesh mesh = read(settings_of(folder.write("t.glb", glb())));
    ASSERT_EQ(triangles(mesh), 1U);
    float widest = 0;
    for (const Vertex& v : mesh.vertices) widest = std::max(widest, v.position_m.x);
    EXPECT_FLOAT_EQ(widest, 2);
}

TEST(ReadModel, RefusesGltfThatIsCutOffAnywhere)
{
    const TemporaryFolder folder;
    const std::string text = read_bytes(kModels / "lamp.gltf"), binary = glb();
    for (std::size_t length = 1; length + 2 < text.size();
         length += 1 + text.size() / 60)  // its last byte is a line end
        EXPECT_NE(error_of(folder.write("cut.gltf", text.substr(0, length))), "") << length;
    for (std::size_t length = 1; length < binary.size(); length += 7)
        EXPECT_NE(error_of(folder.write("cut.glb", binary.substr(0, length))), "") << length;
}

TEST(ReadModel, SurvivesAnyByteThatIsWrong)
{
    const TemporaryFolder folder;
    std::map<std::string, std::string> sound = {{"x.glb", glb()},
                                                {"x.gltf", read_bytes(kModels / "lamp.gltf")}};
    sound["x.obj"] = std::string(kTriangle) + "usemtl a\nvn 0 0 1\nf 1//1 2//1 3//1\n";
    int refused = 0;
    for (const auto& [name, bytes] : sound)
        for (std::uint32_t trial = 0; trial < 60; ++trial)
        {
            std::string broken = bytes;
            const Philox4<std::uint32_t> draw = philox<std::uint32_t>(7, {trial, 1, 2, 3});
            for (unsigned flips = 0; flips <= draw.x2 % 3; ++flips)
                broken[(draw.x0 + flips * draw.x3) % broken.size()] =
                    static_cast<char>(draw.x1 >> (8 * flips));
            refused +=
                error_of(folder.write(name, broken)).empty() ? 0 : 1;  // whatever it says, it comes back
        }
    EXPECT_GT(refused, 30);
}

TEST(ReadModel, RefusesGltfThatPointsOutOfItself)
{
    const TemporaryFolder folder;
    const auto with = [&](std::string_view from, std::string_view to)
    {
        std::string bytes = glb();
        const std::size_t at = bytes.find(from);
        EXPECT_NE(at, std::string::npos);
        EXPECT_EQ(from.size(), to.size()) << "the chunk must keep its length";
        return error_of(folder.write("t.glb", bytes.replace(at, from.size(), to)));
    };
    EXPECT_THAT(with("\"count\":3,\"type\":\"VEC3\"", "\"count\":9,\"type\":\"VEC3\""),
                HasSubstr("out of its bufferView"));
    EXPECT_THAT(with("\"byteLength\":36", "\"byteLength\":99"), HasSubstr("out of its buffer"));
    EXPECT_THAT(with("\"POSITION\":0", "\"POSITION\":7"), HasSubstr("there are 2 accessors"));
    EXPECT_THAT(with("\"mesh\":0", "\"mesh\":8"), HasSubstr("there are 1 meshes"));
    EXPECT_THAT(with("\"scale\":[2,2,2]", "\"children\":[0] "), HasSubstr("below itself"));
    std::string index = glb();
    index[index.size() - 4] = 99;
    EXPECT_NE(error_of(folder.write("t.glb", index)), "") << "a vertex index out of range";
}

TEST(ReadModel, NeverLooksOutsideOfItsFolder)
{
    const TemporaryFolder folder;
    std::filesystem::create_directory(folder / "in");
    folder.write("secret.mtl", "newmtl a\nKd 1 0 0\n");
    folder.write("in/t.obj", "mtllib ../secret.mtl\nusemtl a\n" + std::string(kTriangle));
    const Mesh mesh = read(settings_of(folder / "in/t.obj"));
    for (const Material& m : mesh.materials) EXPECT_FALSE(m.albedo.r == 1 && m.albedo.g == 0);
}

}  // namespace
}  // namespace spindrift::scene
