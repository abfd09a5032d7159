// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/scene/small_scene.h"

namespace spindrift::scene
{
namespace
{

using testing::HasSubstr;
using testing::StartsWith;

TEST(SceneErrors, TextThatIsNotToml)
{
    EXPECT_EQ(error_of(""),
              "s.toml:1: the scene is empty (nothing says where it snows); it needs at least [domain], "
              "[particles] and [camera]");
    EXPECT_EQ(error_of("# only a comment\n"), error_of(""));
    const std::string cases[] = {changed("capacity = 1000", "capacity = "),
                                 changed("capacity = 1000", "capacity = 1 2"),
                                 changed("capacity = 1000", "capacity = \"\xff\xfe\""),
                                 changed("capacity = 1000", "capacity = 1e999")};
    for (const std::string& text : cases)
    {
        EXPECT_THAT(error_of(text), StartsWith("s.toml:5: is not TOML ("));
        EXPECT_THAT(error_of(text), HasSubstr("); use the syntax of toml.io, version 1.0"));
        EXPECT_THAT(error_of(text), testing::Not(HasSubstr("\n")));
    }
}

TEST(SceneErrors, LettersOutsideOfQuotes)
{
    EXPECT_THAT(error_of(changed("1000", "1000 \xc3\xa9")), StartsWith("s.toml:5: is not TOML ("));
    EXPECT_THAT(error_of(changed("1000", "1000 \xe3\x81\x82")), StartsWith("s.toml:5: is not TOML ("));
    EXPECT_THAT(error_of("[\n"), StartsWith("s.toml:1: is not TOML ("));
    EXPECT_THAT(error_of("[\xc3\xa9]\n"), StartsWith("s.toml:1: is not TOML ("));
    EXPECT_EQ(error_of(with("[scene]\nabout = \"\"\"\\\n  \xc3\xa9t\xc3\xa9 \"\"\" # \xc3\xa9\n")), "");
}

TEST(SceneErrors, DuplicateKeysAndTables)
{
    EXPECT_THAT(error_of(changed("capacity = 1000", "capacity = 1\ncapacity = 2")),
                StartsWith("s.toml:6: is not TOML ("));
    EXPECT_THAT(error_of(with("[domain]\n")), StartsWith("s.toml:9: is not TOML ("));
    EXPECT_THAT(error_of(with("[domain]\n")), HasSubstr("domain"));
}

TEST(SceneErrors, DeepNesting)
{
    const std::string open(1000, '['), close(1000, ']');
    EXPECT_THAT(error_of(with("x = " + open + close + "\n")), StartsWith("s.toml:9: is not TOML ("));
    std::string dotted = "a";
    for (int i = 0; i < 100000; ++i) dotted += ".a";
    EXPECT_EQ(error_of(with(dotted + " = 1\n")),
              "s.toml:9: the line holds 100000 dots (keys would nest too deep); use at most 200");
}

TEST(SceneErrors, TooLong)
{
    EXPECT_EQ(
        error_of(std::string(1024 * 1024 + 1, '\n')),
        "s.toml:1: the file holds 1048577 bytes (a scene is a few kilobytes of text); use at most 1048576");
}

TEST(SceneErrors, LongAndStrangeValuesStayOneLine)
{
    const std::string error =
        error_of(with("[scene]\nseed = \"" + std::string(10000, 'x') + "\\n\\u0007\"\n"));
    EXPECT_LT(error.size(), 300U);
    EXPECT_THAT(error, testing::Not(HasSubstr("\n")));
    EXPECT_THAT(error_of(with("\"a\\nb\" = 1\n")), HasSubstr("a?b = 1 is not known"));
}

struct Case
{
    std::string text, error;
};

void expect_errors(const std::vector<Case>& cases)
{
    for (const Case& one : cases) EXPECT_EQ(error_of(one.text), one.error);
}

TEST(SceneErrors, UnknownNamesTheNearest)
{
    const std::string tables =
        "use scene, domain, particles, simulation, snow, wind, vehicle, emitter, ground, box, model, voxels, "
        "air, light, sky, camera, render, bloom or display";
    expect_errors({
        {with("[scene]\nsede = 4\n"),
         "s.toml:10: scene.sede = 4 is not known (the nearest known one is scene.seed); use name, about, "
         "seed or step_s"},
        {with("[winds]\nspeed_m_s = 4\n"),
         "s.toml:9: winds is not known (the nearest known one is wind); " + tables},
        {with("[blizzard]\n"), "s.toml:9: blizzard is not known (nothing here is called so); " + tables},
        {with("eyes = 4\n"),
         "s.toml:9: camera.key[1].eyes = 4 is not known (nothing here is called so); use time_s, eye_m or "
         "look_at_m"},
        // a slip in a required key is named as such, not as a missing key
        {changed("max_m", "mx_m"),
         "s.toml:3: domain.mx_m = [10, 10, 10] is not known (the nearest known one is domain.max_m); "
         "use min_m, max_m or on_leave"},
    });
}

TEST(SceneErrors, WrongTypes)
{
    const std::string speed = " (speed along the ground, at reference_height_m in a log wind); use 0 to 150";
    const std::string wind = "[wind]\nsource = \"uniform\"\nspeed_m_s = ";
    expect_errors({
        {with(wind + "\"fast\"\n"), "s.toml:11: wind.speed_m_s = \"fast\" is a text, not a number" + speed},
        {with(wind + "true\n"), "s.toml:11: wind.speed_m_s = true is true or false, not a number" + speed},
        {with(wind + "[1]\n"), "s.toml:11: wind.speed_m_s = [1] is a list, not a number" + speed},
        {with("[wind]\nsource = 4\n"),
         "s.toml:10: wind.source = 4 is a number, not a text (still air, one velocity, a logarithmic "
         "profile, a wind model's files, or a wind that is solved for round what stands there); use calm, "
         "uniform, "
         "log, file or solve"},
        {with("[wind]\nsource = \"log\"\nspeed_m_s = 1\nturbulence = 1\n"),
         "s.toml:12: wind.turbulence = 1 is a number, not true or false (gusts: of the neutral surface "
         "layer, or of "
         "turbulence_file (without one the default is false)); use true or false"},
        {changed("[10, 10, 10]", "[10, 10]"),
         "s.toml:3: domain.max_m = [10, 10] is a list of 2, not of 3 (upper corner); use three numbers [a, "
         "b, c], each "
         "-100000000 to 100000000"},
        {changed("[10, 10, 10]", "[10, \"high\", 10]"),
         "s.toml:3: domain.max_m = [10, \"high\", 10] is a text, not a number (upper corner); use three "
         "numbers [a, b, c], "
         "each -100000000 to 100000000"},
        {changed("[10, 10, 10]", "10"),
         "s.toml:3: domain.max_m = 10 is a number, not a list (upper corner); use three numbers [a, b, c], "
         "each -100000000 to "
         "100000000"},
        {changed("1000", "10.5"),
         "s.toml:5: particles.capacity = 10.5 is not a whole number (room for so many drawn flakes at once, "
         "fixed for the "
         "run); use a whole number, 1 to 4294967295, as far as memory goes (60 B a flake)"},
        {with("[emitter]\nshape = \"point\"\n"),
         "s.toml:9: emitter = {...} is a table, not a list of tables (what makes flakes; none: the air stays "
         "empty); write "
         "[[emitter]]"},
        {with("[[render]]\nframes = 3\n"),
         "s.toml:9: render = [{...}] is a list, not a table (the pictures); write [render]"},
        {with("[[box]]\nmin_m = 3\n"),
         "s.toml:10: box[1].min_m = 3 is a number, not a list (lower corner); use three numbers [a, b, c], "
         "each -100000000 to "
         "100000000"},
    });
}

TEST(SceneErrors, NumbersOutOfReason)
{
    const std::string speed = " (speed along the ground, at reference_height_m in a log wind); use 0 to 150";
    const std::string wind = "[wind]\nsource = \"uniform\"\nspeed_m_s = ";
    const std::string along =
        " (speed is measured along the wind; turn it with from_direction_deg); use 0 to 150";
    expect_errors({
        {with(wind + "nan\n"), "s.toml:11: wind.speed_m_s = nan is not a number" + speed},
        {with(wind + "inf\n"), "s.toml:11: wind.speed_m_s = inf is not finite" + speed},
        {with(wind + "-inf\n"), "s.toml:11: wind.speed_m_s = -inf is not finite" + speed},
        {with(wind + "-3\n"), "s.toml:11: wind.speed_m_s = -3 is below 0" + along},
        {with(wind + "1e300\n"), "s.toml:11: wind.speed_m_s = 1e+300 is above 150" + along},
        {with(wind + "1e-310\n"),
         "s.toml:11: wind.speed_m_s = 1e-310 is too near 0 to count (it vanishes in single precision); use 0 "
         "to 150"},
        {with("[scene]\nstep_s = 1e-5\n"),
         "s.toml:10: scene.step_s = 1e-05 is below 0.0001 (shorter steps gain nothing, longer "
         "ones blur the wind); use 0.0001 to 10"},
        {with("[scene]\nstep_s = 11\n"),
         "s.toml:10: scene.step_s = 11 is above 10 (shorter steps gain nothing, longer ones "
         "blur the wind); use 0.0001 to 10"},
        {with("[scene]\nseed = -1\n"),
         "s.toml:10: scene.seed = -1 is below 0 (of everything random; the same seed gives the same run, bit "
         "for bit); use a "
         "whole number, 0 to 9.2e18"},
        {with("[snow]\nweight = 0\n"),
         "s.toml:10: snow.weight = 0 is not above 0 (real flakes that one drawn flake stands for, wherever "
         "light is counted); "
         "use above 0, to 1000000000000"},
        {with("[render]\nexposure = \"automatic\"\n"),
         "s.toml:10: render.exposure = \"automatic\" is a text, not a number (factor on all light before the "
         "tone curve; \"auto\": "
         "what shows the picture's log-average as grey); use above 0, to 1000000, or \"auto\""},
        {with("[render]\nexposure = 0\n"),
         "s.toml:10: render.exposure = 0 is not above 0 (factor on all light before the tone curve; "
         "\"auto\": "
         "what shows the picture's log-average as grey); use above 0, to 1000000, or \"auto\""},
        {with("[render]\ngrey = 0.2\n"),
         "s.toml:10: render.grey = 0.2 has no effect here (it counts only with exposure = \"auto\"); remove "
         "it, "
         "or make that so"},
        {with("[bloom]\nthreshold = 1\n"),
         "s.toml:10: bloom.threshold = 1 has no effect here (it counts only with weight above 0); remove it, "
         "or "
         "make that so"},
        {with("[bloom]\nweight = 0.1\nceiling = 1\n"),
         "s.toml:11: bloom.ceiling = 1 is not above threshold = 1 (nothing would be bright); use more than "
         "threshold"},
        {with("[bloom]\nweight = 0.1\nmethod = \"pyramids\"\n"),
         "s.toml:11: bloom.method = \"pyramids\" is not among the choices (nearest: pyramid); use gaussian, "
         "reduced, pyramid, dual or legacy"},
        {with("[display]\ntone = \"calibrated\"\n"),
         "s.toml:10: display.tone = \"calibrated\" has no calibration (no luminance is known); give "
         "unit_cd_m2 "
         "and white_cd_m2"},
        {with("[display]\nunit_cd_m2 = 100\n"),
         "s.toml:9: display.white_cd_m2 is missing (luminance of the display's white, as measured); use "
         "above "
         "0, to 1000000"},
        {with("[render]\nexposure = 2\n[display]\ntone = \"calibrated\"\nunit_cd_m2 = 1\nwhite_cd_m2 = 9\n"),
         "s.toml:12: display.tone = \"calibrated\" would not show cd/m2 as they are with a render.exposure "
         "other than 1; take render.exposure away"},
        {with("[render]\nexposure = \"auto\"\n[display]\ntone = \"legacy\"\n"),
         "s.toml:12: display.tone = \"legacy\" has no gain without a number for render.exposure; set "
         "render.exposure"},
        {with("[render]\nframes = 0\n"),
         "s.toml:10: render.frames = 0 is below 1 (to draw without a window; also --frames); use a whole "
         "number, 1 to 10000000"},
        {with("[render]\nwidth_px = 16385\n"),
         "s.toml:10: render.width_px = 16385 is above 16384 (OpenGL draws no larger "
         "picture); use a whole number, 1 to 16384"},
        {with("[render]\nheight_px = 0\n"),
         "s.toml:10: render.height_px = 0 is below 1 (OpenGL draws no larger picture); use a "
         "whole number, 1 to 16384"},
        {with("[render]\nframes_per_s = 0\n"),
         "s.toml:10: render.frames_per_s = 0 is below 0.01 (of the film; also --fps); use "
         "0.01 to 1000"},
        {with("[render]\ndepth_bits = 20\n"),
         "s.toml:10: render.depth_bits = 20 is not a width that the sorts have (whole bytes); use 16, 24 or "
         "32"},
    });
}

TEST(SceneErrors, DomainWithoutInside)
{
    const std::string tail =
        " is not above min_m in x, y and z (a domain without inside holds no flake); use max_m at least "
        "0.01 above min_m on each axis";
    expect_errors({
        {changed("[10, 10, 10]", "[10, 0, 10]"), "s.toml:3: domain.max_m = [10, 0, 10]" + tail},
        {changed("[10, 10, 10]", "[10, 10, -5]"), "s.toml:3: domain.max_m = [10, 10, -5]" + tail},
        {changed("[10, 10, 10]", "[10, 1e-9, 10]"), "s.toml:3: domain.max_m = [10, 1e-09, 10]" + tail},
        {changed("[10, 10, 10]", "[10, nan, 10]"),
         "s.toml:3: domain.max_m = [10, nan, 10] is not a number (upper corner); use "
         "three numbers [a, b, c], each -100000000 to 100000000"},
    });
}

TEST(SceneErrors, MissingKeysAndTables)
{
    expect_errors({
        {changed("max_m = [10, 10, 10]\n", ""),
         "s.toml:1: domain.max_m is missing (upper corner); use three numbers [a, b, c], "
         "each -100000000 to 100000000"},
        {"[scene]\n", "s.toml:1: domain is missing (where flakes live); write [domain]"},
        {with("[wind]\nsource = \"uniform\"\n"),
         "s.toml:9: wind.speed_m_s is missing (speed along the ground, at reference_height_m in a log wind); "
         "use 0 to 150"},
        {with("[wind]\nsource = \"file\"\n"),
         "s.toml:9: wind.winds_file is missing (QES-Winds *_windsWk.nc; also by --wind on the command line); "
         "use the path of a "
         "file, absolute or from the scene's folder"},
        {with("[ground]\nkind = \"height-field\"\n"),
         "s.toml:9: ground.file is missing (grey PNG of 8 or 16 bit that spans the domain, its first row at "
         "the largest y); use "
         "the path of a file, absolute or from the scene's folder"},
        {with("[[emitter]]\nburst = 3\n"),
         "s.toml:9: emitter[1].shape is missing (where flakes begin, uniformly); use point, line, "
         "sphere-surface, "
         "sphere-volume, plane, box, sky or drift"},
        {with("[[vehicle]]\nname = \"plow\"\n"),
         "s.toml:9: vehicle[1].key is missing (where it is, piecewise linear in time, held at both ends); "
         "write "
         "[[vehicle[1].key]]"},
    });
}

TEST(SceneErrors, TooManyFlakesSayTheMemory)
{
    for (const char* capacity : {"1000000000000", "1e12"})
    {
        const std::string error = error_of(changed("1000", capacity));
        EXPECT_THAT(
            error,
            StartsWith("s.toml:5: particles.capacity = 1000000000000 does not fit (at 60 B a flake that is "
                       "60.0 TB, this machine has "));
        EXPECT_THAT(error, HasSubstr(" GB, and ids have 32 bits); use 1 to "));
    }
    EXPECT_THAT(error_of(changed("1000", "4294967296")), HasSubstr("257.7 GB"));
    EXPECT_THAT(error_of(changed("1000", "0")), StartsWith("s.toml:5: particles.capacity = 0 is below 1 ("));
    SceneOverrides overrides;
    overrides.particles = 1'000'000'000'000;
    EXPECT_THAT(error_of(kSmallScene, overrides),
                StartsWith("command line: particles.capacity = 1000000000000 does not fit (at 60 B a flake "
                           "that is 60.0 TB, "));
    overrides.particles = 0;
    EXPECT_THAT(error_of(kSmallScene, overrides),
                StartsWith("command line: particles.capacity = 0 does not fit ("));
    overrides.particles = UINT64_MAX;
    EXPECT_THAT(error_of(kSmallScene, overrides),
                StartsWith("command line: particles.capacity = 1.8446744073709552e+19 "));
}

TEST(SceneErrors, EmittersWithoutRoomOrPlace)
{
    const std::string point = "[[emitter]]\nshape = \"point\"\nat_m = [1, 1, 1]\n";
    expect_errors({
        {with(point + "burst = 1001\n"),
         "s.toml:12: emitter[1].burst = 1001 has no room (particles.capacity is 1000, emitters before this "
         "one start with 0); "
         "use 0 to 1000, or a larger capacity"},
        {with(point + "burst = 800\n" + point + "burst = 300\n"),
         "s.toml:16: emitter[2].burst = 300 has no room (particles.capacity is 1000, emitters before this "
         "one start with 800); "
         "use 0 to 200, or a larger capacity"},
        {with(point + "rate_per_s = 1e6\n"),
         "s.toml:12: emitter[1].rate_per_s = 1000000 has no room (a step of 0.016666666666666666 s alone "
         "makes more flakes than "
         "particles.capacity = 1000); use at most 60000, or a larger capacity"},
        {with(point),
         "s.toml:9: emitter[1] makes no flakes (rate_per_s and burst are 0); use a rate_per_s or a burst "
         "above 0, or "
         "leave the emitter out"},
        {with("[[emitter]]\nshape = \"sphere-volume\"\ncentre_m = [1, 1, 1]\nradius_m = 2\nburst = 3\n"),
         "s.toml:10: emitter[1].shape = \"sphere-volume\" reaches out of the domain (flakes made there would "
         "leave at once); "
         "move or shrink it into [0, 0, 0] to [10, 10, 10]"},
        {with("[[emitter]]\nshape = \"line\"\nfrom_m = [1, 1, 1]\nto_m = [1, 1, 1]\nburst = 3\n"),
         "s.toml:12: emitter[1].to_m = [1, 1, 1] equals from_m (the line has no length); use two different "
         "ends, or shape = "
         "\"point\""},
        {with("[[emitter]]\nshape = \"plane\"\ncorner_m = [1, 1, 1]\nedge_u_m = [1, 0, 0]\nedge_v_m = [2, 0, "
              "0]\nburst = 3\n"),
         "s.toml:13: emitter[1].edge_v_m = [2, 0, 0] is parallel to edge_u_m, or one of them is 0 (the plane "
         "has no area); use "
         "two edges in different directions, or shape = \"line\""},
        {with("[[emitter]]\nshape = \"box\"\nmin_m = [1, 1, 1]\nmax_m = [2, 1, 2]\nburst = 3\n"),
         "s.toml:12: emitter[1].max_m = [2, 1, 2] is not above min_m (the box has no inside); use max_m "
         "above min_m on each "
         "axis, or shape = \"plane\""},
        {with(point + "burst = 3\nradius_m = 2\n"),
         "s.toml:13: emitter[1].radius_m = 2 has no effect here (it counts only with shape = "
         "\"sphere-surface\" or "
         "\"sphere-volume\"); remove it, or make that so"},
        {with("[[emitter]]\nshape = \"sky\"\nfollows = \"camera\"\nsize_m = [2, 2, 2]\nburst = 3\ncentre_m = "
              "[1, 1, 1]\n"),
         "s.toml:14: emitter[1].centre_m = [1, 1, 1] has no effect here (it counts only with shape = "
         "\"sphere-surface\" or "
         "\"sphere-volume\", or \"sky\" without follows); remove it, or make that so"},
    });
    std::string many;
    for (int i = 0; i < 256; ++i) many += point + "burst = 1\n";
    EXPECT_EQ(error_of(with(many)),
              "s.toml:1030: emitter[256].shape = \"point\" is the 256th emitter (a flake keeps its emitter "
              "in 8 bits); use at most 255");
}

TEST(SceneErrors, CamerasThatSeeNothing)
{
    const std::string up =
        " is straight above or below eye_m (no side of the picture would be up); move it sideways by a "
        "thousandth of the distance or more";
    const std::string between =
        " makes the camera look straight up or down, or at itself, on the way from the key before; add a "
        "key between them";
    expect_errors({
        {changed("[5, 5, 2]", "[0, -10, 2]"),
         "s.toml:8: camera.key[1].look_at_m = [0, -10, 2] equals eye_m (the camera looks "
         "nowhere); use a point at least 0.001 m away from eye_m"},
        {changed("[5, 5, 2]", "[0, -10, 20]"), "s.toml:8: camera.key[1].look_at_m = [0, -10, 20]" + up},
        {changed("[5, 5, 2]", "[0, -10, -20]"), "s.toml:8: camera.key[1].look_at_m = [0, -10, -20]" + up},
        {with("[camera]\nnear_m = 10\nfar_m = 5\n"),
         "s.toml:11: camera.far_m = 5 is not above near_m = 10 (nothing would be seen); use more than "
         "near_m"},
        {with("[camera]\nnear_m = 0\n"),
         "s.toml:10: camera.near_m = 0 is below 0.001 (nothing nearer is drawn); use 0.001 to "
         "10000"},
        {with("[camera]\nfov_y_deg = 180\n"),
         "s.toml:10: camera.fov_y_deg = 180 is above 170 (a flat picture holds no wider angle); use 1 to "
         "170"},
        {with("[[camera.key]]\neye_m = [0, 0, 2]\nlook_at_m = [5, 5, 2]\n"),
         "s.toml:9: camera.key[2].time_s is not later than the key before it (a path runs forward); use "
         "ascending times"},
        {with("[[camera.key]]\ntime_s = 1\neye_m = [5, 10, 2]\nlook_at_m = [0, -5, 2]\n"),
         "s.toml:12: camera.key[2].look_at_m = [0, -5, 2]" + between},
    });
}

TEST(SceneErrors, NamesTwiceAndReferencesToNobody)
{
    const std::string plow = "[[vehicle]]\nname = \"plow\"\n[[vehicle.key]]\nposition_m = [1, 2, 3]\n";
    const std::string lamp =
        "[[light]]\nkind = \"point\"\nname = \"lamp\"\nposition_m = [1, 1, 1]\nintensity_w_sr = [1, 1, 1]\n";
    expect_errors({
        {with(plow + plow),
         "s.toml:14: vehicle[2].name = \"plow\" names a second vehicle (references would be ambiguous); use "
         "each "
         "name once"},
        {with("[[vehicle]]\nname = \"camera\"\n[[vehicle.key]]\nposition_m = [1, 2, 3]\n"),
         "s.toml:10: vehicle[1].name = \"camera\" does not name a vehicle (empty means none, and \"camera\" "
         "is the camera); use "
         "another name"},
        {with(lamp + lamp),
         "s.toml:16: light[2].name = \"lamp\" names a second light (it could not be told apart); use each "
         "name "
         "once"},
        {with(plow + "[[emitter]]\nshape = \"sky\"\nsize_m = [2, 2, 2]\nburst = 3\nfollows = \"plough\"\n"),
         "s.toml:17: emitter[1].follows = \"plough\" names no vehicle of this scene (a [[vehicle]] must have "
         "that name); use camera or "
         "plow"},
        {with(plow + "[[emitter]]\nshape = \"sky\"\nsize_m = [2, 2, 2]\nburst = 3\nfollows = \"plwo\"\n"),
         "s.toml:17: emitter[1].follows = \"plwo\" names no vehicle of this scene (nearest: plow); use "
         "camera or plow"},
        {with("[[model]]\nfile = \"x.obj\"\nvehicle = \"plow\"\n"),
         "s.toml:11: model[1].vehicle = \"plow\" names no vehicle of this scene (a [[vehicle]] must have "
         "that name); add a "
         "[[vehicle]]"},
        {with(plow + lamp + "vehicle = \"polw\"\n"),
         "s.toml:18: light[1].vehicle = \"polw\" names no vehicle of this scene (nearest: plow); use plow"},
    });
}

const std::string kSorts =
    "use auto, none, qsort, std, std-par, radix, counting16, vqsort, block-indirect, passes, bitonic-passes, "
    "odd-even-passes, cub-radix, thrust, cub-merge, bitonic or bucket16";

TEST(SceneErrors, ChoicesNameTheNearest)
{
    expect_errors({
        {with("[render]\nsort = \"radx\"\n"),
         "s.toml:10: render.sort = \"radx\" is not among the choices (nearest: radix); " + kSorts},
        {with("[render]\nsort = \"quick\"\n"),
         "s.toml:10: render.sort = \"quick\" is not among the choices (strategy of the depth sort "
         "(docs/sorting.md); also --sort); " +
             kSorts},
        {with("[render]\nsort_passes_per_frame = 0\n"),
         "s.toml:10: render.sort_passes_per_frame = 0 is below 1 (steps of bitonic-passes and "
         "odd-even-passes; also --sort-passes); use a whole number, 1 to 4096"},
        {with("[snow]\ncrystal = \"dendrite\"\n"),
         "s.toml:10: snow.crystal = \"dendrite\" is not among the choices (nearest: dendrites); use "
         "dendrites, plates, rimed or "
         "graupel"},
        {with("[domain.x]\n"),
         "s.toml:9: domain.x is not known (nothing here is called so); use min_m, max_m or on_leave"},
    });
}

TEST(SceneErrors, Contradictions)
{
    expect_errors({
        {with("[wind]\nsource = \"log\"\nspeed_m_s = 3\nfriction_velocity_m_s = 0.3\n"),
         "s.toml:11: wind.speed_m_s = 3 has no effect here (it counts only with source = \"uniform\", source "
         "or profile = \"log\" without friction_velocity_m_s, or profile = \"power\"); remove it, or make "
         "that so"},
        {with("[wind]\nspeed_m_s = 3\n"),
         "s.toml:10: wind.speed_m_s = 3 has no effect here (it counts only with source = \"uniform\", source "
         "or profile = \"log\" without friction_velocity_m_s, or profile = \"power\"); remove it, or make "
         "that so"},
        {with("[wind]\nsource = \"log\"\nspeed_m_s = 3\nreference_height_m = 1\nroughness_m = 2\n"),
         "s.toml:12: wind.reference_height_m = 1 is not above roughness_m (the profile is 0 there); use a "
         "larger height or a "
         "smaller roughness_m"},
        {with("[wind]\nsource = \"file\"\nwinds_file = \"a.nc\"\nturbulence_file = \"b.nc\"\nturbulence = "
              "false\n"),
         "s.toml:13: wind.turbulence = false contradicts turbulence_file (the gusts of a wind file come from "
         "that file); leave out one of the two"},
        {with("[ground]\nkind = \"none\"\ncontact = \"land\"\n"),
         "s.toml:11: ground.contact = \"land\" has no effect here (it counts only with kind = \"plane\" or "
         "\"height-field\"); "
         "remove it, or make that so"},
        {with("[ground]\nrestitution = 0.5\n"),
         "s.toml:10: ground.restitution = 0.5 has no effect here (it counts only with "
         "contact = \"bounce\"); remove it, or make that so"},
        {with("[ground]\nheight_m = 10\n"),
         "s.toml:10: ground.height_m = 10 is not below the top of the domain (flakes would have "
         "no room); use less than domain.max_m's z"},
        {with("[[light]]\nkind = \"directional\"\ndirection = [0, 0, -1]\nintensity_w_sr = [1, 1, 1]\n"),
         "s.toml:12: light[1].intensity_w_sr = [1, 1, 1] has no effect here (it counts only with kind = "
         "\"point\" or \"spot\"); "
         "remove it, or make that so"},
        {with("[[light]]\nkind = \"directional\"\ndirection = [0, 0, 0]\nirradiance_w_m2 = [1, 1, 1]\n"),
         "s.toml:11: light[1].direction = [0, 0, 0] has no length (it points nowhere); use a vector longer "
         "than 1e-6"},
    });
}

TEST(SceneErrors, GridsThatDoNotFit)
{
    expect_errors({
        {with("[voxels]\nsize_m = 0.01\n[[box]]\nmin_m = [0, 0, 0]\nmax_m = [1, 1, 1]\n"),
         "s.toml:10: voxels.size_m = 0.01 gives 1e+09 voxels in this domain (at 2 B each 2.0 GB); use a "
         "larger size, at most "
         "134217728 voxels"},
        {with("[wind]\nsource = \"log\"\nspeed_m_s = 3\naround_solids = true\ncell_m = 0.05\n"), ""},
    });
    const std::string large =
        std::string("[domain]\nmin_m = [0, 0, 0]\nmax_m = [1000, 1000, 1000]\n") +
        "[particles]\ncapacity = 1\n[wind]\nsource = \"log\"\nspeed_m_s = 3\naround_solids = true\n" +
        "cell_m = 1\n[[camera.key]]\neye_m = [0, 0, 0]\nlook_at_m = [1, 0, 0]\n";
    EXPECT_EQ(
        error_of(large),
        "s.toml:10: wind.cell_m = 1 gives 1e+09 cells in this domain (at 64 B a cell 64.0 GB); use larger "
        "cells, at most 16777216 of them");
}

TEST(SceneErrors, CommandLine)
{
    SceneOverrides overrides;
    overrides.sort = "quick";
    EXPECT_EQ(error_of(kSmallScene, overrides),
              "command line: render.sort = \"quick\" is not among the choices (strategy of the depth sort "
              "(docs/sorting.md); also --sort); " +
                  kSorts);
    overrides = {};
    overrides.frames = 0;
    EXPECT_EQ(error_of(kSmallScene, overrides),
              "command line: render.frames = 0 is below 1 (to draw without a window; also "
              "--frames); use a whole number, 1 to 10000000");
    overrides = {};
    overrides.winds_file = "/a.nc";
    EXPECT_EQ(error_of(kSmallScene, overrides),
              "command line: wind.winds_file = \"/a.nc\" has no effect here (it counts only with "
              "source = \"file\"); remove it, or make that so");
    overrides = {};
    overrides.width_px = -5;
    EXPECT_THAT(error_of(kSmallScene, overrides),
                StartsWith("command line: render.width_px = -5 is below 1 ("));
}

}  // namespace
}  // namespace spindrift::scene
