// SPDX-License-Identifier: MIT
// Included once per instruction set, with SPINDRIFT_TEST_REAL and SPINDRIFT_TEST_LIST defined.
#include "core/emit.h"
#include "core/light.h"
#include "core/math.h"
#include "core/phase.h"
#include "core/philox.h"
#include "core/snow.h"
#include "core/walk.h"
#include "number_operations.h"

namespace spindrift
{
namespace
{

using R = SPINDRIFT_TEST_REAL;
using Int = spindrift::IntOf<R>;
using UInt = spindrift::UIntOf<R>;

SPINDRIFT_HD UInt as_bits(const R& x)
{
    return bits(x);
}
SPINDRIFT_HD UInt word(const UInt& x)
{
    return x;
}
SPINDRIFT_HD UInt signed_word(const Int& x)
{
    return as_uint(x);
}
SPINDRIFT_HD UInt truth(const spindrift::MaskOf<R>& m)
{
    return select(m, UInt(1U), UInt(0U));
}

/// The words as numbers between -2^7 and 2^7 or so, for functions that are not asked about every number.
SPINDRIFT_HD R moderate(const UInt& w)
{
    return to_real<R>(as_int(w)) * number<R>(0x1p-24);
}

template <class Body>
SPINDRIFT_HD void for_all(const spindrift_test::OperationData& d, const Body& body)
{
    for (int i = 0; i < d.n; i += spindrift::NumberTraits<R>::width)
        store(d.out + i, body(load<UInt>(d.a + i), load<UInt>(d.b + i), load<UInt>(d.c + i)));
}

// NaN has many patterns, of which core promises none: one stands for all
SPINDRIFT_HD UInt number_bits(const R& x)
{
    return select(x == x, bits(x), UInt(0x7fc00000U));
}

#define OPERATION(name, result)                                                                     \
    {                                                                                               \
        name, [](const spindrift_test::OperationData& d)                                            \
        {                                                                                           \
            for_all(                                                                                \
                d, [](const UInt& a, const UInt& b, const UInt& c) __attribute__((always_inline)) { \
                    [[maybe_unused]] const R x = from_bits(a), y = from_bits(b), z = from_bits(c);  \
                    [[maybe_unused]] const Int i = as_int(a), j = as_int(b);                        \
                    return result;                                                                  \
                });                                                                                 \
        }                                                                                           \
    }

SPINDRIFT_HD UInt sine_bits(const R& x)
{
    R s, c;
    sincos_turns(x, s, c);
    return number_bits(s);
}
SPINDRIFT_HD UInt cosine_bits(const R& x)
{
    R s, c;
    sincos_turns(x, s, c);
    return number_bits(c);
}
SPINDRIFT_HD UInt wide_low(const UInt& a, const UInt& b)
{
    UInt high, low;
    multiply_wide(a, b, high, low);
    return low;
}
SPINDRIFT_HD UInt lanes_back(const UInt& a)
{
    UInt out(0U);
    for (int lane = 0; lane < spindrift::NumberTraits<R>::width; ++lane) insert(out, lane, extract(a, lane));
    return out;
}

const float kTable[8] = {1, -2, 3.5F, -0.0F, 1e30F, 1e-40F, 7, 8};
const std::uint8_t kBytes[12] = {1, 2, 255, 128, 5, 6, 7, 8, 0, 0, 0, 0};

[[gnu::noinline]] UInt wind_noise(const UInt& id, const UInt& step_bits)
{
    const auto g =
        spindrift::gaussians<R>(spindrift::random_words(99, id, 17U, spindrift::RandomStream::turbulence, 2));
    return number_bits(g.x) ^ (number_bits(g.y) >> 1) ^ (number_bits(g.z) >> 2) ^ (number_bits(g.w) >> 3) ^
           step_bits;
}

[[gnu::noinline]] UInt start_place(const UInt& id, spindrift::EmitterShape shape)
{
    spindrift::Emitter emitter;
    emitter.shape = shape;
    emitter.a = {1, 2, 3}, emitter.b = {4, 6, 9}, emitter.c = {-2, 0.1F, 5};
    emitter.radius_m = 2.5F;
    const auto p = spindrift::StartSampler<R>(emitter, 5)(id);
    return number_bits(p.x) ^ (number_bits(p.y) >> 1) ^ (number_bits(p.z) >> 2);
}

[[gnu::noinline]] UInt fall_speed(const UInt& id, spindrift::Crystal crystal)
{
    spindrift::Snow snow;
    snow.crystal = crystal;
    return number_bits(spindrift::FallSpeed(snow, 3).at<R>(id));
}

SPINDRIFT_HD UInt diameter(const UInt& id)
{
    return number_bits(spindrift::FlakeSizes({}, 3).diameter_m<R>(id));
}

[[gnu::noinline]] UInt free_way(const UInt& a, const UInt& b)
{
    static const std::uint8_t clearance[8 + 3] = {2, 1, 1, 0, 3, 2, 2, 1, 0, 0, 0};
    spindrift::Solids solids;
    solids.voxels.nx = solids.voxels.ny = solids.voxels.nz = 2;
    solids.voxels.cell_m = 16, solids.voxels.cells_per_m = 1.0F / 16;
    solids.voxels.clearance = clearance;
    solids.has_ground = true;
    solids.ground_m = 0.5F;
    const spindrift::Vec3<R> start{moderate(a), moderate(b), moderate(a ^ b)};
    const spindrift::Vec3<R> way{moderate(mix32(a)), moderate(mix32(b)), from_bits(a ^ (b >> 1))};
    return truth(moves_freely(solids, start, way));
}

const spindrift_test::Operation kOperations[] = {
    OPERATION("+", number_bits(x + y)),
    OPERATION("-", number_bits(x - y)),
    OPERATION("*", number_bits(x* y)),
    OPERATION("/", number_bits(x / y)),
    OPERATION("negate", as_bits(-x)),
    OPERATION("fma", number_bits(fma(x, y, z))),
    OPERATION("fma moderate", number_bits(fma(moderate(a), moderate(b), moderate(c)))),
    OPERATION("sqrt", number_bits(sqrt(x))),
    OPERATION("abs", as_bits(abs(x))),
    OPERATION("copysign", as_bits(copysign(x, y))),
    OPERATION("min", as_bits(min(x, y))),
    OPERATION("max", as_bits(max(x, y))),
    OPERATION("clamp", as_bits(spindrift::clamp(x, moderate(b), moderate(b) + R(1)))),
    OPERATION("==", truth(x == y)),
    OPERATION("== self", truth(x == x)),
    OPERATION("!=", truth(x != y)),
    OPERATION("<", truth(x < y)),
    OPERATION("<=", truth(x <= y)),
    OPERATION(">", truth(x > y)),
    OPERATION(">=", truth(x >= y)),
    OPERATION("&&", truth(x < y && y < z)),
    OPERATION("||", truth(x < y || y < z)),
    OPERATION("!", truth(!(x < y))),
    OPERATION("select", as_bits(select(x < y, x, z))),
    OPERATION("is_finite", truth(is_finite(x))),
    OPERATION("round", number_bits(round(x))),
    OPERATION("round moderate", as_bits(round(moderate(a)))),
    OPERATION("floor", number_bits(floor(x))),
    OPERATION("floor moderate", as_bits(floor(moderate(a)))),
    OPERATION("round_to_int", signed_word(round_to_int(x))),
    OPERATION("floor_to_int", signed_word(floor_to_int(x))),
    OPERATION("to_real", as_bits(to_real<R>(i))),
    OPERATION("uint +", word(a + b)),
    OPERATION("uint -", word(a - b)),
    OPERATION("uint *", word(a* b)),
    OPERATION("uint & | ^", word((a & b) ^ (b | c))),
    OPERATION("uint <<", word(a << 7)),
    OPERATION("uint >>", word(a >> 7)),
    OPERATION("uint <", truth(a < b)),
    OPERATION("uint >=", truth(a >= b)),
    OPERATION("uint ==", truth((a & UInt(3U)) == (b & UInt(3U)))),
    OPERATION("uint select", select(a > b, a, c)),
    OPERATION("multiply_high", multiply_high(a, b)),
    OPERATION("multiply_wide low", wide_low(a, b)),
    OPERATION("int >>", signed_word(i >> 5)),
    OPERATION("int <", truth(i < j)),
    OPERATION("int <=", truth(i <= j)),
    OPERATION("int min", signed_word(min(i, j))),
    OPERATION("int max", signed_word(max(i, j))),
    OPERATION("int select", signed_word(select(i > j, i, j))),
    OPERATION("int small *", signed_word((i >> 17) * (j >> 17))),
    OPERATION("lanes", lanes_back(a)),
    OPERATION("gather", as_bits(gather(kTable, as_int(a& UInt(7U))))),
    OPERATION("gather_bytes", signed_word(gather_bytes(kBytes, as_int(a& UInt(7U))))),
    OPERATION("log2", number_bits(log2(x))),
    OPERATION("log", number_bits(log(x))),
    OPERATION("exp2", number_bits(exp2(x))),
    OPERATION("exp2 moderate", number_bits(exp2(moderate(a)))),
    OPERATION("exp", number_bits(exp(x))),
    OPERATION("exp moderate", number_bits(exp(moderate(a)))),
    OPERATION("atan", number_bits(atan(x))),
    OPERATION("atan moderate", number_bits(atan(moderate(a)))),
    OPERATION("pow", number_bits(pow(abs(moderate(a)), moderate(b) * R(0.0625F)))),
    OPERATION("sin", sine_bits(x)),
    OPERATION("cos", cosine_bits(x)),
    OPERATION("sin moderate", sine_bits(moderate(a))),
    OPERATION("cos moderate", cosine_bits(moderate(a))),
    OPERATION("mix32", mix32(a)),
    OPERATION("gaussians", wind_noise(a, b)),
    OPERATION("start on sphere", start_place(a, spindrift::EmitterShape::sphere_surface)),
    OPERATION("start in sphere", start_place(a, spindrift::EmitterShape::sphere_volume)),
    OPERATION("start on plane", start_place(a, spindrift::EmitterShape::plane)),
    OPERATION("start in box", start_place(a, spindrift::EmitterShape::box)),
    OPERATION("start in sky", start_place(a, spindrift::EmitterShape::sky)),
    OPERATION("diameter", diameter(a)),
    OPERATION("fall speed, dendrites", fall_speed(a, spindrift::Crystal::dendrites)),
    OPERATION("fall speed, graupel", fall_speed(a, spindrift::Crystal::graupel)),
    OPERATION("henyey_greenstein",
              number_bits(spindrift::henyey_greenstein(moderate(a) * R(0.0078F), moderate(b) * R(0.0078F)))),
    OPERATION("moves_freely", free_way(a, b)),
    {nullptr, nullptr},
};

}  // namespace
}  // namespace spindrift

const spindrift_test::Operation* spindrift_test::SPINDRIFT_TEST_LIST()
{
    return spindrift::kOperations;
}
