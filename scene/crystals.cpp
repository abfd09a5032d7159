// SPDX-License-Identifier: MIT
#include "scene/crystals.h"
#include "core/sprite.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace spindrift::scene
{

namespace
{

// Vapour and ice in units of 2^-18 of what freezes a cell.
constexpr int kFreezes = 1 << 18;
// Lattice: axial coordinates q, r, each -kRim..kRim; the crystal stops at kReach cells so that its vapour
// still has room.
constexpr int kRim = 56;
constexpr int kReach = 46;
constexpr int kWidth = 2 * kRim + 1;
constexpr int kCells = kWidth * kWidth;
constexpr std::array<int, 6> kNeighbours{1, -1, kWidth, -kWidth, kWidth - 1, 1 - kWidth};
constexpr int kMostSteps = 4000;

/// Reiter's parameters: vapour at the start and far away, and vapour that falls on the crystal from above in
/// each step.
struct Weather
{
    double beta, gamma;
};

// Chosen by eye for variety: plates, sectors, stars and ferns.
constexpr std::array<Weather, kCrystalShapes> kWeathers{{{0.30, 0.0001},
                                                         {0.35, 0.0010},
                                                         {0.40, 0.0010},
                                                         {0.40, 0.0030},
                                                         {0.45, 0.0001},
                                                         {0.50, 0.0010},
                                                         {0.55, 0.0100},
                                                         {0.60, 0.0030},
                                                         {0.70, 0.0005},
                                                         {0.80, 0.0030},
                                                         {0.90, 0.0500},
                                                         {0.95, 0.0000}}};

int index(int q, int r)
{
    return (r + kRim) * kWidth + q + kRim;
}

int hex_distance(int q, int r)
{
    return (std::abs(q) + std::abs(r) + std::abs(q + r)) / 2;
}

class Growth
{
  public:
    explicit Growth(const Weather& weather)
        : far_(static_cast<int>(weather.beta * kFreezes)), fall_(static_cast<int>(weather.gamma * kFreezes))
    {
        ice_.fill(far_);
        vapour_.fill(far_);
        frozen_.fill(0);
        inside_.fill(0);
        for (int r = -kRim + 1; r < kRim; ++r)
            for (int q = -kRim + 1; q < kRim; ++q)
                if (hex_distance(q, r) < kRim) inside_[index(q, r)] = 1;
        ice_[index(0, 0)] = kFreezes;
        frozen_[index(0, 0)] = 1;
        for (int step = 0; step < kMostSteps && reach() < kReach; ++step) grow();
    }

    bool ice(int q, int r) const { return hex_distance(q, r) < kRim && frozen_[index(q, r)] != 0; }

    /// Distance of the outermost ice from the middle; the tips lie on the axes.
    int reach() const
    {
        int out = 0;
        while (out + 1 < kRim && frozen_[index(out + 1, 0)] != 0) ++out;
        return out;
    }

  private:
    void grow()
    {
        constexpr int begin = kWidth + 1;
        constexpr int end = kCells - kWidth - 1;
        for (int i = begin; i < end; ++i)
        {
            int touched = frozen_[i];
            for (const int n : kNeighbours) touched |= frozen_[i + n];
            receptive_[i] = touched;
            vapour_[i] = touched != 0 ? 0 : ice_[i];
        }
        for (int i = begin; i < end; ++i)
        {
            int sum = 0;
            for (const int n : kNeighbours) sum += vapour_[i + n];
            const int diffused = vapour_[i] + (((sum - 6 * vapour_[i]) * kTwelfth) >> kShift);
            const int held = receptive_[i] != 0 ? ice_[i] + fall_ : 0;
            // Ice beyond what freezes changes nothing; capping it keeps the sums small.
            const int next = std::min(diffused + held, 2 * kFreezes);
            ice_[i] = inside_[i] != 0 ? next : far_;
            frozen_[i] = inside_[i] != 0 && next >= kFreezes ? 1 : 0;
        }
    }

    // Diffusion of strength 1: u + (mean of the neighbours - u) / 2 = u + (sum - 6 u) / 12.
    static constexpr int kShift = 10;
    static constexpr int kTwelfth = (1 << kShift) / 12;

    int far_, fall_;
    std::array<int, kCells> ice_{}, vapour_{}, receptive_{}, frozen_{}, inside_{};
};

/// The lattice cell that holds a point given in cell widths (x along q; r leans by 60 degrees).
bool ice_at(const Growth& growth, double x, double y)
{
    const double rf = y * 2.0 / std::sqrt(3.0);
    const double qf = x - 0.5 * rf;
    const double sf = -qf - rf;
    double q = std::floor(qf + 0.5);
    double r = std::floor(rf + 0.5);
    const double s = std::floor(sf + 0.5);
    const double dq = std::abs(q - qf);
    const double dr = std::abs(r - rf);
    const double ds = std::abs(s - sf);
    if (dq > dr && dq > ds)
        q = -r - s;
    else if (dr > ds)
        r = -q - s;
    return growth.ice(static_cast<int>(q), static_cast<int>(r));
}

std::vector<std::uint8_t> finest_level(const Growth& growth)
{
    constexpr int n = kCrystalMaskPx;
    constexpr int sub = 4;
    // The outermost corner of the outermost cell touches the disc's border, one texel inside.
    const double cells_per_unit = (growth.reach() + 0.6) / (1.0 - 2.0 / n);
    std::vector<std::uint8_t> texels(static_cast<std::size_t>(n) * n);
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column)
        {
            int hits = 0;
            for (int k = 0; k < sub * sub; ++k)
            {
                const double u = (column + (k % sub + 0.5) / sub) * 2.0 / n - 1.0;
                const double v = (row + (k / sub + 0.5) / sub) * 2.0 / n - 1.0;
                if (u * u + v * v <= 1 && ice_at(growth, u * cells_per_unit, v * cells_per_unit)) ++hits;
            }
            texels[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column)] =
                static_cast<std::uint8_t>((hits * 255 + sub * sub / 2) / (sub * sub));
        }
    return texels;
}

std::vector<std::uint8_t> half_size(const std::vector<std::uint8_t>& fine, std::size_t fine_px)
{
    const std::size_t n = fine_px / 2;
    std::vector<std::uint8_t> coarse(n * n);
    for (std::size_t row = 0; row < n; ++row)
        for (std::size_t column = 0; column < n; ++column)
        {
            const std::uint8_t* at = &fine[2 * row * fine_px + 2 * column];
            coarse[row * n + column] =
                static_cast<std::uint8_t>((at[0] + at[1] + at[fine_px] + at[fine_px + 1] + 2) / 4);
        }
    return coarse;
}

double weighted_mean(const std::vector<std::uint8_t>& texels)
{
    constexpr int n = kCrystalMaskPx;
    double sum = 0;
    double weights = 0;
    for (int row = 0; row < n; ++row)
        for (int column = 0; column < n; ++column)
        {
            const double u = (column + 0.5) * 2.0 / n - 1.0;
            const double v = (row + 0.5) * 2.0 / n - 1.0;
            const double rho2 = u * u + v * v;
            if (rho2 > 1) continue;
            const double weight = std::exp(-rho2 / (2 * kProfileSigma * kProfileSigma));
            sum +=
                weight * texels[static_cast<std::size_t>(row) * n + static_cast<std::size_t>(column)] / 255.0;
            weights += weight;
        }
    return sum / weights;
}

double bilinear(const std::vector<std::uint8_t>& texels, int px, double u, double v)
{
    const double x = (u * 0.5 + 0.5) * px - 0.5;
    const double y = (v * 0.5 + 0.5) * px - 0.5;
    const double fx = x - std::floor(x);
    const double fy = y - std::floor(y);
    const auto texel = [&](double column, double row)
    {
        const int c = std::clamp(static_cast<int>(column), 0, px - 1);
        const int r = std::clamp(static_cast<int>(row), 0, px - 1);
        return texels[static_cast<std::size_t>(r) * static_cast<std::size_t>(px) +
                      static_cast<std::size_t>(c)] /
               255.0;
    };
    const double c = std::floor(x);
    const double r = std::floor(y);
    return (texel(c, r) * (1 - fx) + texel(c + 1, r) * fx) * (1 - fy) +
           (texel(c, r + 1) * (1 - fx) + texel(c + 1, r + 1) * fx) * fy;
}

}  // namespace

std::vector<CrystalMask> grow_crystals()
{
    std::vector<CrystalMask> masks;
    for (const Weather& weather : kWeathers)
    {
        const Growth growth(weather);
        CrystalMask mask;
        mask.levels.push_back(finest_level(growth));
        mask.mean = weighted_mean(mask.levels.front());
        for (std::size_t px = kCrystalMaskPx; px > 1; px /= 2)
            mask.levels.push_back(half_size(mask.levels.back(), px));
        masks.push_back(std::move(mask));
    }
    return masks;
}

const std::vector<CrystalMask>& crystal_masks()
{
    static const std::vector<CrystalMask> masks = grow_crystals();
    return masks;
}

double sample_mask(const CrystalMask& mask, double u, double v, double level)
{
    const double last = static_cast<double>(mask.levels.size()) - 1;
    const auto nearest = static_cast<std::size_t>(std::clamp(std::floor(level + 0.5), 0.0, last));
    return bilinear(mask.levels[nearest], kCrystalMaskPx >> nearest, u, v);
}

}  // namespace spindrift::scene
